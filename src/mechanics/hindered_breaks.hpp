// The reasons why bonds do not break in equilibria.
#pragma once

#include <string>

#include "mechanics/body.hpp"

namespace strut {

// True if bonds of the block can break in equilibria.
bool breaks_at_rest(const MaterialBlock& block);

// The first reason in this body, such as "Symmetry Plane"; empty if there is none. Contact and tools are not
// considered.
std::string hindrance_of_breaks(const Body& body);

}  // namespace strut
