// What a search of contact is given and what it finds: the present kinematics of points, two blocks, their pairs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "topology/domain.hpp"

namespace strut::contact {

// This rank's points as they are now. Ghosts are looked at only where bonds to them have broken.
struct Kinematics {
  const Domain& domain;
  std::span<const Vector> velocities;  // m/s
  std::span<const double> densities;   // kg/m³
};

// The two blocks that may touch, and this rank's points of them.
struct BlockPair {
  int first = 0, second = 0;  // blocks; the same: a block that touches itself
  bool one_body = false;      // the blocks are bonded to each other where they are near
  bool by_surfaces = false;   // they touch at their surfaces, however near each other their points were at first
  std::vector<int> points;    // owned, of either block, ascending

  bool self() const { return first == second; }
};

// How many bonds of each owned point have broken; empty where none may.
using BrokenCounts = std::vector<std::size_t>;

// Points that have a partner, then the partners of other ranks. Both ends of a pair have it in their lists.
struct Pairs {
  std::vector<int> owned;         // local indices in the body, ascending
  std::vector<Site> sites;        // of the owned ones, then of the others: places as of the search or the last exchange
  std::vector<double> masses;     // kg
  std::vector<std::int64_t> ids;  // of the sites' points, the others' ascending
  std::vector<std::size_t> start{0};  // partners of owned[k]: partners[start[k]] … partners[start[k + 1] − 1],
  std::vector<int> partners;          // indices into sites, ordered by global id
  bool one_body = false;              // as in BlockPair
  std::optional<Halo> halo;           // of sites; none where no rank has a partner on another

  bool empty() const { return owned.empty(); }
};

// Collective. Sets the places of the sites.
void bring_to_present(const Kinematics& kinematics, Pairs& pairs);

}  // namespace strut::contact
