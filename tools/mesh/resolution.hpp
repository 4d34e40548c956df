// How well the cells of a mesh resolve its struts.
#pragma once

#include <string>

namespace strut::mesh {

// A line, indented, about `members` (struts) so many cells thick: what a run is to be expected to be wrong by.
std::string resolution_of(const std::string& members, double cells);

}  // namespace strut::mesh
