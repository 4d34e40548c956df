// Interpenetration of material: of bodies in contact, whatever the distance at which their points touch, and without a
// declared contact between bodies, or within a body that folds.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contact/contact.hpp"
#include "topology/domain.hpp"

namespace strut::contact {

struct Interpenetration {
  int first = 0, second = 0;  // blocks
  std::int64_t points = 0;    // of either block: number inside the other now, less that in the reference state
  double part = 0;            // these points, as a fraction of the points of the smaller block
  int point = -1;             // one of them: local index on its owner, −1 on other ranks
};

// Collective. The first two blocks of different bodies with an interaction that have more than `limit` (a fraction of
// the smaller one's points) inside each other. A point is inside if it is as deep in the material of the other body as
// the nearest points of that body (docs/theory.md). Blocks whose bounding boxes are disjoint cost only a reduction.
std::optional<Interpenetration> find_interpenetration(const Domain& domain, const Contact& contact, double limit);

// Two blocks of different bodies, and this rank's points of them that are inside the other block now.
struct Overlap {
  int first, second;
  std::vector<int> points;
};

// Collective. All pairs of blocks whose bounding boxes overlap; `points` may be empty.
std::vector<Overlap> overlapping_blocks(const Domain& domain);

// Collective. Points at surfaces, of blocks without contact, that are closer to another one than half of the shorter
// edge of both cells, but began farther apart than that edge (in two bodies) or both horizons (in one). The result has
// the blocks of `point` and its partner (equal within a block), on the owner of `point` only, and no `part`. Costs
// nothing if all blocks may touch each other and themselves, or if hardly anything has moved.
std::optional<Interpenetration> find_undeclared(const Domain& domain, const Contact& contact);

}  // namespace strut::contact
