// The critical stretch or bond energy for which a crack dissipates the given fracture energy, at a given spacing.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Sets the critical stretch or bond energy of the blocks whose fracture energy is given, from a lattice of their
// spacing and horizon.
void set_critical_values(Body& body);

// Sets the length over which a crack smears its opening, for blocks whose points may fail: twice the reach of their
// families, because all points within it on both sides of a displacement jump have it in their deformation gradients.
// The reach is the block's largest horizon, or 1.75 spacings by quadratic correspondence, so a graded block takes less
// energy where it is finer.
void set_crack_lengths(Body& body);

}  // namespace strut
