// The forces through periodic sides.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// This rank's part of the force through the sides of each of domain.periods, along its axis, tension positive, N: the
// change of the bonds' energy with the period. When to call it: mirror_forces.hpp.
std::vector<Vector> period_forces(const Body& body, int level, const std::vector<int>* moved);

}  // namespace strut
