// Who may touch whom: the pairs of two blocks (or of one) that are nearer than a reach and not bonded.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/pair_law.hpp"
#include "points/domain.hpp"
#include "points/site.hpp"

namespace strut::contact {

// This rank's points as they are now; what stands behind the owned ones is not looked at.
struct Crowd {
  const Domain& domain;
  std::span<const Site> sites;
  std::span<const Vector> velocities;  // m/s
  std::span<const double> densities;   // kg/m³
};

// This rank's owned points of the two blocks that may touch, ascending.
struct Parties {
  std::vector<int> first, second;
  bool self = false;      // one block, with no second party
  bool one_body = false;  // the blocks are bonded to each other where they are near
};

// Points that have a partner, then the partners of other ranks. Both ends of a pair have it in their lists.
struct Pairs {
  std::vector<int> owned;      // local indices in the body, ascending
  std::vector<Site> sites;     // of the owned ones, then of the others: places as of the search or the last exchange
  std::vector<double> masses;  // kg
  std::vector<std::size_t> start{0};  // partners of owned[k]: partners[start[k]] … partners[start[k + 1] − 1],
  std::vector<int> partners;          // indices into sites, ordered by global id
  bool one_body = false;              // see Parties
  std::optional<Halo> halo;           // of sites; none where no rank has a partner on another

  bool empty() const { return owned.empty(); }
};

// Collective. All pairs of the parties that are nearer than the distance at which they touch + skin (m) and not bonded.
Pairs find_pairs(const Crowd& crowd, const Parties& parties, const Model& model, double skin);

// Collective. The distance (m) between the bounding boxes of the two parties: 0 where they overlap, infinity where one
// of them has no points.
double distance_of_boxes(const Crowd& crowd, const Parties& parties);

}  // namespace strut::contact
