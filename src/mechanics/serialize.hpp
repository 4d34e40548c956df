// The part of a body that a checkpoint contains: everything that steps change.
#pragma once

#include <set>
#include <string>

#include "base/archive.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Collective. Leaves the archive at the group of all owned points. On restoring, ghosts get the positions of their
// owners; time-step levels are not included (multi_time_stepping.hpp).
void serialize(Archive& archive, Body& body);
// Collective. The check sum of the node sets, for a run that goes on with the same ones, except for some by name.
void serialize_sets(Archive& archive, const Body& body, const std::set<std::string>& without);

// The ids of owned points, over all ranks.
std::vector<std::int64_t> ids_of(const Body& body, const std::vector<int>& points);

}  // namespace strut
