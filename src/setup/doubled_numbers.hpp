// Elements or nodes to which a mesh gives one number: frames and messages name them alike.
#pragma once

#include <string>

#include "points/domain.hpp"

namespace strut {

// Collective. A warning with the least number that more than one point has, and how many are such; "" where there is
// none.
std::string doubled_numbers(const Domain& domain);

}  // namespace strut
