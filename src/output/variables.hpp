// What a deck asks to see of a body, by name.
#pragma once

#include "conditions/reactions.hpp"
#include "deck/deck.hpp"
#include "output/observables.hpp"

namespace strut {

// "Reaction_X(wall)": a component of the force of the condition `wall` on the body, N.
struct ReactionComponent {
  std::string name;
  int condition, component;

  double of(const Reactions& reactions) const { return reactions.forces[condition][component]; }
};

struct OutputVariables {
  std::vector<Observable> frame;             // Output > Output Variables
  std::vector<Extreme> extremes;             // History > Variables
  std::vector<ReactionComponent> reactions;  // History > Variables
};

// Collective. Throws one Error for all unknown names, extremes over no point, and reactions of what has none.
OutputVariables output_variables_of(const deck::Deck& deck, const Body& body);

}  // namespace strut
