// The symmetry planes that run through a point.
#pragma once

#include <vector>

#include "topology/domain.hpp"

namespace strut {

// The planes of the body of an owned point that run through it.
std::vector<Mirror> planes_through(const Domain& domain, int i);

// Number of images at the position of an owned point, itself included: 2 on a symmetry plane, each with half of a cell.
int coincident_images(const Domain& domain, int i);

}  // namespace strut
