// From a deck to the objects of a run: the one place that knows both.
#pragma once

#include "deck/deck.hpp"
#include "setup/scene.hpp"

namespace strut {

// Collective. Reads the mesh, makes node sets, partition, families, body, initial velocities and conditions.
// Throws one Error on all ranks for what only mesh and deck together show: blocks and node sets that do not exist or
// hold no point, horizons that do not fit the spacing; then one for points with too few neighbors.
Scene set_up(const deck::Deck& deck, const Communicator& communicator);

// What is made anew when a partition is, of a scene that has to be gone by then.
struct Kept {
  PointCloud cloud;  // as it is to be on this rank
  Cuts cuts;
  Dropped dropped;
  std::int64_t points = 0, bonds = 0, pieces = 0;
  std::vector<ToolOfScene> tools;
};

// Collective. The same scene on another partition, at its initial time; what it tells is not told again.
Scene set_up_again(const deck::Deck& deck, Kept kept, const Communicator& communicator);

}  // namespace strut
