// Checks of what rigid tools meet on their paths, by these and the initial velocities.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A line for each tool that is initially more than a spacing away from all of its points: when it first
// touches one, or the warning that it touches none. It is a forecast: motion by loads and impacts is not considered.
std::string apart_tools(const Situation& situation);

// Collective. A warning for every two tools, one of them with a mass, that meet by their paths and initial velocities
// before a point stops one: tools do not interact.
std::string meeting_tools(const Situation& situation);

// Collective. A warning for each tool thinner than 1.5 spacings where it meets a block: a roll by its diameter, a box
// by the edges of the face that meets the block, unless they extend across it. Tools stop points only.
std::string thin_tools(const Situation& situation);

}  // namespace strut
