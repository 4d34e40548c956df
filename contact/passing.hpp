// Bodies that pass through each other, whatever the distance at which their points touch.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contact/contact.hpp"
#include "topology/domain.hpp"

namespace strut::contact {

struct Passing {
  int first = 0, second = 0;  // blocks
  std::int64_t points = 0;    // of either that are inside the other and were not in the reference state
  double part = 0;            // the same as a part of the points of the smaller one
  int point = -1;             // one of them, on the rank that owns it: local index; -1 on the others
};

// Collective. The first two blocks of different bodies with an interaction of which more than `limit`, as a part of the
// points of the smaller one, are inside each other: where a point is as deep in the material of the other body as the
// points of it that are nearest (docs/theory.md). Whose bounding boxes do not overlap costs a reduction only.
std::optional<Passing> find_passing(const Domain& domain, const Contact& contact, double limit);

// Two blocks of different bodies, and this rank's points of them that are inside of the other one in the reference
// state.
struct Overlap {
  int first, second;
  std::vector<int> points;
};

// Collective. Of all blocks whose bounding boxes overlap; `points` may be empty.
std::vector<Overlap> overlapping_blocks(const Domain& domain);

}  // namespace strut::contact
