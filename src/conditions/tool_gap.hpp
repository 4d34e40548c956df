// How far two rigid tools are from each other.
#pragma once

#include "conditions/rigid_tool.hpp"

namespace strut {

// At time t (s), m; nothing below where they overlap, as tools without ends do that are not parallel.
double gap_between(const RigidTool& one, const RigidTool& other, double t);

// Whether forces drive at least one of two tools: the deck then does not say that they shall overlap.
inline bool may_meet(const RigidTool& one, const RigidTool& other) { return one.free || other.free; }

}  // namespace strut
