// The gap between two rigid tools.
#pragma once

#include "conditions/rigid_tool.hpp"

namespace strut {

// Gap at time t (s), m; not positive if they overlap; −∞ for infinite tools that are not parallel.
double gap_between(const RigidTool& one, const RigidTool& other, double t);

// True if forces drive at least one of two tools, so that the deck does not intend them to overlap.
inline bool may_meet(const RigidTool& one, const RigidTool& other) { return one.free || other.free; }

}  // namespace strut
