// Elements or nodes to which a mesh gives one number: frames and messages name them alike.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A warning with the least number that more than one point has, and how many are such; "" where there is
// none.
std::string doubled_numbers(const Situation& situation);

}  // namespace strut
