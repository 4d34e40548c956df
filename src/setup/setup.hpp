// From a deck to the objects of a run: the one place that knows both.
#pragma once

#include "deck/deck.hpp"
#include "setup/scene.hpp"

namespace strut {

// Collective. Reads the mesh, makes node sets, partition, families, body, initial velocities and conditions.
// Throws one Error on all ranks for what only mesh and deck together show: blocks and node sets that do not exist or
// hold no point, horizons that do not fit the spacing; then one for points with too few neighbors.
Scene set_up(const deck::Deck& deck, const Communicator& communicator);

}  // namespace strut
