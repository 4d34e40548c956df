// The resolution of struts by the cells of a mesh.
#pragma once

#include <string>

namespace strut::mesh {

// An indented line about `members` (struts) this many cells thick: the errors to expect in a run.
std::string resolution_of(const std::string& members, double cells);

}  // namespace strut::mesh
