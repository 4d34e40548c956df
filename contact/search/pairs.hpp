// Input and result of a contact search: the present kinematics of points, two blocks, and their pairs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "contact/laws/contact_law.hpp"
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
  // The largest distance, m, at which points that are `apart` in the mesh touch; `radius`: r_c.
  double touching(double radius, double apart) const {
    const bool anywhere = by_surfaces && !one_body;
    return anywhere ? radius : largest_touching_distance(radius, apart, one_body);
  }
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
  std::vector<double> limits;         // of partners: they touch at this distance at most, m (breaks.hpp); empty: none
  bool one_body = false;              // as in BlockPair
  std::optional<Halo> halo;           // of sites; none if no rank has a partner on another rank
  // For each site and axis, the number of periods by which an image is above its original; empty without periods.
  std::vector<Vector> above = {};
  Vector friction_through = Vector::Zero();  // N, of this rank's last friction through the sides across each axis

  // The part of the force through the sides, N, that a partner's force on an owned point brings.
  Vector through_sides(int partner, const Vector& force) const {
    return above.empty() ? Vector::Zero() : Vector(above[partner].cwiseProduct(force));
  }

  bool empty() const { return owned.empty(); }
};

// Collective. Updates the positions of the sites.
void bring_to_present(const Kinematics& kinematics, Pairs& pairs);

// Candidates: the points that a search on this rank knows, and the criterion by which two of them may touch.

// A candidate, in the form in which it is sent to other ranks.
struct Candidate {
  double reference[4], current[4];  // of Site
  double mass, skin;                // kg; its skin distance, m
  std::int64_t id;
  int block, owned;    // owned: its local index on the rank that owns it
  std::int64_t owner;  // that rank
};

inline Vector place(const Candidate& c) { return {c.current[0], c.current[1], c.current[2]}; }
inline Vector reference(const Candidate& c) { return {c.reference[0], c.reference[1], c.reference[2]}; }

// Owned points, ascending, then those of other ranks.
struct CandidatePool {
  std::vector<Candidate> members;
  std::size_t owned = 0;

  bool owns(int m) const { return m < static_cast<int>(owned); }
};

// True if two candidates may touch before both have used up their skin distances.
struct Criterion {
  double radius;  // r_c, m
  const BlockPair& blocks;

  bool operator()(const Candidate& a, const Candidate& b) const {
    if (!within_reach(a, b)) return false;
    return !(blocks.one_body && bonded(a.current[3], b.current[3], reference(b) - reference(a)));
  }

  bool within_reach(const Candidate& a, const Candidate& b) const {
    const double apart = (reference(b) - reference(a)).norm();
    const double reach = blocks.touching(radius, apart) + (a.skin + b.skin);  // the same from both ends
    return (place(b) - place(a)).squaredNorm() <= reach * reach;
  }
};

}  // namespace strut::contact
