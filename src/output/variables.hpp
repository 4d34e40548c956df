// The output variables of a deck, by name.
#pragma once

#include "conditions/reactions.hpp"
#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "output/crack_tip.hpp"
#include "output/means.hpp"
#include "output/observables.hpp"

namespace strut {

// "Reaction_X(wall)": a component of the force of the condition `wall` on the body, N, as a mean since the previous
// row, or as "Instant_Reaction_X(wall)" at the time of the row.
struct ReactionComponent {
  std::string name;
  int condition, component;
  bool is_instant;

  double of(const std::vector<Vector>& of_conditions) const { return of_conditions[condition][component]; }
};

// "Crack_Tip(notch)" or "Crack_Speed(notch)" of History > Cracks.
struct CrackColumn {
  std::string name;
  std::size_t crack;  // index in OutputVariables::cracks
  bool is_speed;

  double of(const CrackTip& tip) const { return is_speed ? tip.speed() : tip.tip(); }
};

// "Contact_Force_X(foam:plate)": a component of the contact force of the second block on the first, N; mean or instant.
struct ContactComponent {
  std::string name;
  int first, second, component;
  bool is_instant;
};

struct OutputVariables {
  std::vector<Observable> frame;             // Output > Output Variables
  std::vector<Reduction> extremes;           // History > Variables
  std::vector<ReactionComponent> reactions;  // History > Variables
  std::vector<CrackColumn> crack_columns;    // History > Variables
  std::vector<CrackTip> cracks;              // cracks of these columns
  std::vector<Reduction> means;              // History > Variables
  std::vector<ContactComponent> contacts;    // History > Variables
};

// Collective. Reports unknown names, as far as a deck (which may have errors) and its mesh show, and names that the
// files cannot hold. `cloud`: empty if there is no mesh.
void check_output_variables(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                            deck::Problems& problems);

// Collective. Throws one Error for all unknown names, extremes over no point, reactions of conditions without any,
// cracks where none can form, and contact of blocks that have none with each other.
OutputVariables output_variables_of(const deck::Deck& deck, const Body& body, const contact::Contact& contact);

}  // namespace strut
