// Which candidates may touch each other, found by clusters of them.
//
// A cubic cell holds some 64 candidates as they are now, and its clusters are the octants about its center. Of two
// cells, then of their clusters, the bounding volumes are asked first, as many at a time as a register holds, whether
// they are
//   far         no two of their points within r_c and their skin distances,
//   bonded      all within the smallest horizon of each other in the reference state (within a body), or
//   undeformed  no two that are not bonded closer by so much of a horizon as a touch takes, less their skin distances
//               (the same),
// and point by point only where they are none of these. Where material has hardly been strained everything within a
// body is undeformed, wherever it is and however it has turned.
//
// Undeformed: a point of a cluster stands at y = p + R (X − C) but for its `spread`, with the rotation R that fits
// best. Seen from the frame of the first cluster two points are |ξ + Δ| apart, Δ = R₁ᵀ(p₂ − p₁) − (C₂ − C₁), but for
// both spreads and for |R₂ − R₁| times the size of the second. And |ξ + Δ| − |ξ| varies with ξ by 2 |Δ|/(|ξ| + |ξ + Δ|)
// a length at most (Dunkl & Williams 1964), so by that times both sizes from what it is between the centers.
#pragma once

#include <utility>
#include <vector>

#include "contact/search/candidates.hpp"

namespace strut::contact {

// An owned candidate and its partner: indices into CandidatePool::members.
using IndexPairs = std::vector<std::pair<int, int>>;

// All pairs that may touch, each from every end that is owned.
IndexPairs pairs_in(const CandidatePool& candidates, const Criterion& may_touch);

}  // namespace strut::contact
