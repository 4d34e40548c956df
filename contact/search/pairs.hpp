// Input and result of a contact search: the present kinematics of points, two blocks, and their pairs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "topology/domain.hpp"

namespace strut::contact {

// The present kinematics of this rank's points. Ghosts are read only where bonds to them have broken.
struct Kinematics {
  const Domain& domain;
  std::span<const Vector> velocities;  // m/s
  std::span<const double> densities;   // kg/m³
};

// Two blocks that may touch, and this rank's points of them.
struct BlockPair {
  int first = 0, second = 0;  // blocks; equal for a block that touches itself
  bool one_body = false;      // the blocks are bonded to each other where they are near
  bool by_surfaces = false;   // they touch at their surfaces, whatever the initial distance of their points
  std::vector<int> points;    // owned, of either block, ascending

  bool self() const { return first == second; }
};

// The number of broken bonds of each owned point; empty if no bonds may break.
using BrokenCounts = std::vector<std::size_t>;

// Points with partners, then the partners on other ranks. Both ends of a pair list each other.
struct Pairs {
  std::vector<int> owned;             // local indices in the body, ascending
  std::vector<Site> sites;            // owned ones, then the others: positions at the search or the last exchange
  std::vector<double> masses;         // kg
  std::vector<std::int64_t> ids;      // of the sites' points, the others' ascending
  std::vector<std::size_t> start{0};  // partners of owned[k]: partners[start[k]] … partners[start[k + 1] − 1],
  std::vector<int> partners;          // indices into sites, ordered by global id
  bool one_body = false;              // as in BlockPair
  std::optional<Halo> halo;           // of sites; none if no rank has a partner on another rank

  bool empty() const { return owned.empty(); }
};

// Collective. Updates the positions of the sites.
void bring_to_present(const Kinematics& kinematics, Pairs& pairs);

}  // namespace strut::contact
