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

}  // namespace strut
