// Tools that stand between points which are bonded to each other.
#pragma once

#include <optional>
#include <vector>

#include "conditions/rigid_tool.hpp"
#include "topology/domain.hpp"

namespace strut {

// Two neighbors of a body, the first one of this rank (local indices; −1 where another rank has found them).
struct Crossing {
  int point = -1, partner = -1;
};

// Collective. Points of a tool that are bonded, were at most 1.5 spacings from each other at first, and now see
// opposite sides of the tool with some of it between them: a tool stops points only, and a thin one passes between
// them. `places`: of owned points and ghosts at time t (s). Corners of a tool that stand between two points do not
// count, for the points see sides that are not opposite.
std::optional<Crossing> find_crossing(const RigidTool& tool, double t, const Domain& domain,
                                      const std::vector<Vector>& places);

// Collective. Where owned points and ghosts are now.
std::vector<Vector> present_places(const Domain& domain);

}  // namespace strut
