// From a deck to the objects of a run: the one place that knows both.
#pragma once

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "setup/scene.hpp"
#include "topology/cloud.hpp"

namespace strut {

// Collective. The mesh with the node sets that the deck makes, and what only deck and mesh together show to be wrong:
// blocks and node sets that do not exist, mean two things or hold no point, points that are given twice, horizons that
// do not fit the spacing. The deck may have problems of its own already; without a mesh, as the deck's section on it is
// wrong, the cloud is empty.
PointCloud mesh_of(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems);

// Collective. Partition, families, body, initial velocities and conditions, of a mesh and a deck without problems.
// Throws one Error on all ranks for points with too few neighbors.
Scene set_up(const deck::Deck& deck, PointCloud cloud, const Communicator& communicator);
// Both; all problems are one Error.
Scene set_up(const deck::Deck& deck, const Communicator& communicator);

// What is made anew when a partition is, of a scene that has to be gone by then.
struct Kept {
  PointCloud cloud;  // as it is to be on this rank
  Cuts cuts;
  Dropped dropped;
  std::int64_t points = 0, bonds = 0, pieces = 0;
  std::vector<ToolOfScene> tools;
  double highest_frequency = 0;
};

Kept kept_of(const Scene& scene, PointCloud cloud);

// Collective. The same scene on another partition, at its initial time; what it tells is not told again.
Scene set_up_again(const deck::Deck& deck, Kept kept, const Communicator& communicator);

}  // namespace strut
