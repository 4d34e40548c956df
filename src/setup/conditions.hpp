// The boundary conditions of a deck, made for the points of a scene.
#pragma once

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "setup/scene.hpp"

namespace strut {

// Collective. Checks that every condition names a set that contains a point of some rank.
void check_conditions(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                      deck::Problems& problems);

// Collective. Throws Error on all ranks for errors that only mesh and deck together show.
void add_conditions(const deck::Deck& deck, Scene& scene, const Communicator& communicator);

}  // namespace strut
