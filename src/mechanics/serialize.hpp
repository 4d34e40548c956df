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
// Collective. A check sum of the node sets, except for some by name, and its name in a checkpoint.
inline constexpr const char* mark_of_sets_name = "node_sets";
double mark_of_sets(const Body& body, const std::set<std::string>& without);
// Collective. The same, for a run that goes on with the same sets.
void serialize_sets(Archive& archive, const Body& body, const std::set<std::string>& without);

// The ids of owned points, over all ranks.
std::vector<std::int64_t> ids_of(const Body& body, const std::vector<int>& points);
inline std::vector<std::int64_t> owned_ids(const Body& body) {
  return {body.domain.cloud.ids.begin(), body.domain.cloud.ids.begin() + body.owned()};
}

}  // namespace strut
