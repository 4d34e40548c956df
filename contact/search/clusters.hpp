// Finds candidates that may touch each other, by clusters.
//
// A cubic cell holds some 64 candidates at their present positions, and its clusters are the octants around their
// center. The bounding volumes of two cells, then of their clusters, are tested first, as many at a time as a register
// has lanes. They may be
//   far         no two of their points are within r_c and their skin distances,
//   bonded      all are within the smallest horizon of each other in the reference state (within a body), or
//   undeformed  no two that are not bonded are close enough, in fractions of a horizon, to touch, with their skin
//               distances (within a body);
// else their points are tested one by one. Where material is hardly strained, all pairs within a body are undeformed,
// whatever the position and rotation of the body.
//
// Undeformed: a point of a cluster is at y = p + R (X − C) up to its `spread`, with the best-fit rotation R. In the
// frame of the first cluster two points are |ξ + Δ| apart, Δ = R₁ᵀ(p₂ − p₁) − (C₂ − C₁), up to both spreads and |R₂ −
// R₁| times the size of the second. |ξ + Δ| − |ξ| changes with ξ by at most 2 |Δ|/(|ξ| + |ξ + Δ|) per length (Dunkl &
// Williams 1964), so it differs by at most that times both sizes from its value at the centers.
#pragma once

#include <utility>
#include <vector>

#include "contact/search/pairs.hpp"

namespace strut::contact {

// An owned candidate and its partner: indices into CandidatePool::members.
using IndexPairs = std::vector<std::pair<int, int>>;

// All pairs that may touch, listed from each end that is owned.
IndexPairs pairs_in(const CandidatePool& candidates, const Criterion& may_touch);

}  // namespace strut::contact
