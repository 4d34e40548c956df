// What keeps bonds from breaking in equilibria.
#pragma once

#include <string>

#include "mechanics/body.hpp"

namespace strut {

// True if the bonds of a block could break there.
bool breaks_at_rest(const MaterialBlock& block);

// What forbids it to them in this body, but for contact and tools: "Symmetry Plane"; empty if nothing does.
std::string hindrance_of_breaks(const Body& body);

}  // namespace strut
