// The part of a body that a checkpoint contains: everything that steps change.
#pragma once

#include "base/archive.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Collective. Leaves the archive at the group of all owned points. On restoring, ghosts get the positions of their
// owners; time-step levels are not included (multi_time_stepping.hpp).
void serialize(Archive& archive, Body& body);
// The same for a body of another run of the same mesh, whose node sets may be others.
void serialize_for_start(Archive& archive, Body& body);

// The ids of owned points, over all ranks.
std::vector<std::int64_t> ids_of(const Body& body, const std::vector<int>& points);

}  // namespace strut
