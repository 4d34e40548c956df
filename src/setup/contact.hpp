// The interactions of a deck as pairs of blocks.
#pragma once

#include <vector>

#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

// Every interaction names blocks of the mesh.
void check_interactions(const deck::Deck& deck, const PointCloud& cloud, deck::Problems& problems);

// Interactions of blocks: the named ones, then every other pair where one names none.
std::vector<contact::Interaction> interactions_of(const deck::Deck& deck, const PointCloud& cloud);

// What contact between surfaces takes from the two bodies: their stiffness and spacing.
void set_surface_laws(const Body& body, std::vector<contact::Interaction>& interactions);

// Collective. A warning for every two blocks that an interaction names and that are bonded to each other, a body of
// which contact sees nothing where they are; of interactions of all blocks only where all these bonds bridge a gap.
std::string bonded_contacts(const deck::Deck& deck, const Domain& domain);

}  // namespace strut
