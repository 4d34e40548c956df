// The symmetry planes that run through a point.
#pragma once

#include <vector>

#include "topology/domain.hpp"

namespace strut {

// Those of the body of an owned point.
std::vector<Mirror> planes_through(const Domain& domain, int i);

// How many images of an owned point are where it is, itself counted: on a symmetry plane 2, each with half of a cell.
int coincident_images(const Domain& domain, int i);

}  // namespace strut
