// Finds rigid tools that are between points bonded to each other, or that overlap another tool.
#pragma once

#include <optional>
#include <vector>

#include "conditions/rigid_tool.hpp"
#include "topology/domain.hpp"

namespace strut {

// Two bonded points, the first one owned by this rank (local indices; −1 if another rank found them).
struct Crossing {
  int point = -1, partner = -1;
};

// Collective. Finds two bonded points, initially at most 1.5 edges of a cell apart, that now face opposite sides of the
// tool with some of it between them: a tool stops points only, so a thin tool passes between points.
// `places`: positions of owned points and ghosts at time t (s). Corners of a tool between two points do not count,
// because the points face sides that are not opposite.
std::optional<Crossing> find_crossing(const RigidTool& tool, double t, const Domain& domain,
                                      const std::vector<Vector>& places);

// Collective. The present positions of owned points and ghosts.
std::vector<Vector> present_positions(const Domain& domain);

// Gap between two tools at time t (s), m; not positive if they overlap; −∞ for infinite tools that are not parallel.
double gap_between(const RigidTool& one, const RigidTool& other, double t);

// True if forces drive at least one of two tools, so that the deck does not intend them to overlap.
inline bool may_meet(const RigidTool& one, const RigidTool& other) { return one.free || other.free; }

}  // namespace strut
