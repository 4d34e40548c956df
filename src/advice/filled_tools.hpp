// Rigid tools that are inside of a body when the run begins.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A warning for each tool in which points lie at the start by more than a hundredth of their spacing:
// those on its surface, as nodes of a mesh that was made for it, do not count.
std::string filled_tools(const Situation& situation);

}  // namespace strut
