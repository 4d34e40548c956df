// Inside mechanics: the correction by which the forces of a uniform stress equal its tractions on the surface
// (quadratic_fit.hpp).
#pragma once

#include "mechanics/formulation/quadratic_fits.hpp"

namespace strut {

// Collective. Finds μ of all points whose surfaces are known, corrects their fits by the trend of μ, and completes
// them.
void make_consistent(Body& body, QuadraticFits& fits);

}  // namespace strut
