// What of a body a checkpoint contains: all that its steps change.
#pragma once

#include "base/archive.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Collective. Leaves the archive at the group of all owned points. Of restored bodies the ghosts' places are as their
// owners'; time-step levels are not among it (multi_time_stepping.hpp).
void serialize(Archive& archive, Body& body);

// The ids of owned points, over all ranks.
std::vector<std::int64_t> ids_of(const Body& body, const std::vector<int>& points);

}  // namespace strut
