// The forces of symmetry planes: what the images of points on the other side give to a body.
#pragma once

#include "base/archive.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Of each of domain.mirrors along its normal, this rank's part, N: after a sum of forces, before anything is added to
// force_density. In a substep, of a time-step level, only the forces on `moved` are current, and only what is due acts.
std::vector<Vector> mirror_forces(const Body& body, int level = 0, const std::vector<int>* moved = nullptr);

void serialize_mirror_forces(Archive& archive, std::vector<Vector>& forces);

}  // namespace strut
