// Inside contact: which members of a pool may touch each other, found by clusters of them.
//
// A cluster is what a cubic cell of some eight points holds now. Two clusters are asked as wholes first, as many at a
// time as a register holds, whether they are
//   far      no two of their points within r_c and their skins,
//   bonded   all within the smallest horizon of each other in the reference state (within a body), or
//   calm     no two that are not bonded closer by so much of a horizon as a touch takes, less their skins (the same),
// and point by point only where they are none of these. Where material has hardly been strained everything within a
// body is calm, however it has turned: of a body in flight, or of the struts that only bend, a search sees the
// clusters.
//
// Calm: with Δ the difference of the displacements of both centres, two points are |ξ + Δ| apart but for what points of
// a cluster move beside its centre (`spread`); and |ξ + Δ| − |ξ| varies with ξ by 2 |Δ|/(|ξ| + |ξ + Δ|) a length at
// most, so by that times both radii from what it is between the centres.
#pragma once

#include <utility>
#include <vector>

#include "contact/pool.hpp"

namespace strut::contact {

using IndexPairs = std::vector<std::pair<int, int>>;  // a member that is owned, and its partner: places in the pool

// All pairs that may touch, each from every end that is owned.
IndexPairs pairs_in(const Pool& pool, const Criterion& may_touch);

}  // namespace strut::contact
