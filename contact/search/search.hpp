// Who may touch whom: the pairs of two blocks (or of one) that are nearer than a reach and not bonded.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "contact/laws/penalty.hpp"
#include "points/domain.hpp"

namespace strut::contact {

// This rank's points as they are now; ghosts are not looked at.
struct Kinematics {
  const Domain& domain;
  std::span<const Vector> velocities;  // m/s
  std::span<const double> densities;   // kg/m³
};

// The two blocks that may touch, and this rank's points of them.
struct BlockPair {
  int first = 0, second = 0;  // blocks; the same: a block that touches itself
  bool one_body = false;      // the blocks are bonded to each other where they are near
  std::vector<int> points;    // owned, of either block, ascending

  bool self() const { return first == second; }
};

// Points that have a partner, then the partners of other ranks. Both ends of a pair have it in their lists.
struct Pairs {
  std::vector<int> owned;         // local indices in the body, ascending
  std::vector<Site> sites;        // of the owned ones, then of the others: places as of the search or the last exchange
  std::vector<double> masses;     // kg
  std::vector<std::int64_t> ids;  // of the sites' points, the others' ascending
  std::vector<std::size_t> start{0};  // partners of owned[k]: partners[start[k]] … partners[start[k + 1] − 1],
  std::vector<int> partners;          // indices into sites, ordered by global id
  bool one_body = false;              // see Parties
  std::optional<Halo> halo;           // of sites; none where no rank has a partner on another

  bool empty() const { return owned.empty(); }
};

// How far each of parties.points may go, beside a motion that all of them share, before pairs are searched for again,
// m.
struct SkinDistances {
  std::vector<float> of;
  double largest = 0;  // over all ranks; those of far points are larger
};

// Collective. All pairs of the parties that are not bonded and may touch before both ends have used up their skins. The
// skins of points that are far from all of the other party become as large as that allows.
Pairs find_pairs(const Kinematics& kinematics, const BlockPair& blocks, const Model& model, SkinDistances& skins);

}  // namespace strut::contact
