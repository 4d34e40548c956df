// Where rigid tools go, and what they meet there, by their paths and the velocities of the start.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A line for each tool that is more than a spacing from every one of its points at the start: when it first
// touches one, or the warning that it touches none until the end. A forecast: what loads and impacts move is not seen.
std::string apart_tools(const Situation& situation);

// Collective. A warning for each two tools, one of them with a mass, that meet by their paths and velocities of the
// start before a point stops one: tools do not see each other.
std::string meeting_tools(const Situation& situation);

// Collective. A warning for each tool that is thinner than 1.5 spacings where it meets a block: a roll by its diameter,
// a box by the edges of the face that comes to the block, where they do not reach across it. Tools stop points only.
std::string thin_tools(const Situation& situation);

}  // namespace strut
