// The axes of the lattice on which points stand, which turn with a body.
#pragma once

#include "topology/domain.hpp"

namespace strut {

// The directions from an owned point to its nearest neighbors, columns of unit length: to the nearest one, to the
// nearest one off that line, and to the nearest one off their plane; without any the third stands on the plane. Zero
// where all neighbors stand on one line.
Tensor lattice_axes(const Domain& domain, int i);

}  // namespace strut
