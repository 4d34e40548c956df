// The interactions of a deck as pairs of blocks.
#pragma once

#include <vector>

#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

// Checks that every interaction names blocks of the mesh.
void check_interactions(const deck::Deck& deck, const PointCloud& cloud, deck::Problems& problems);

// Interactions of blocks: first the named ones, then all other pairs if an interaction names none.
std::vector<contact::Interaction> interactions_of(const deck::Deck& deck, const PointCloud& cloud);

// The interactions of blocks that have points. Laws between surfaces get the stiffness and the spacing of both bodies.
std::vector<contact::Interaction> interactions_of(const deck::Deck& deck, const Body& body);

}  // namespace strut
