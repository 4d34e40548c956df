// Rigid tools that overlap a body at the start.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A warning for each tool with points inside it at the start by more than a hundredth of their spacing;
// points on its surface, such as nodes of a matching mesh, do not count.
std::string filled_tools(const Situation& situation);

}  // namespace strut
