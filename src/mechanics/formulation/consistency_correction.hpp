// Inside mechanics: the correction by which the forces of a uniform stress are those on the surface
// (quadratic_fit.hpp).
#pragma once

#include "mechanics/formulation/quadratic_fits.hpp"

namespace strut {

// Collective. Finds μ of all points where their surfaces are known, corrects their fits by its trends, and completes
// them.
void make_consistent(Body& body, QuadraticFits& fits);

}  // namespace strut
