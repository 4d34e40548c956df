// The forces of symmetry planes: those that the images of points on the other side exert on a body.
#pragma once

#include "base/archive.hpp"
#include "mechanics/body.hpp"

namespace strut {

// This rank's part of the force of each of domain.mirrors along its normal, N. Call it after a sum of forces, before
// force_density changes. In a substep of `level`, only forces on `moved` are current, and only points that are due act.
std::vector<Vector> mirror_forces(const Body& body, int level = 0, const std::vector<int>* moved = nullptr);

void serialize_mirror_forces(Archive& archive, std::vector<Vector>& forces);

}  // namespace strut
