// How the stress follows the jump of the gradient at a point whose bonds break.
#pragma once

#include "base/math/tensors.hpp"
#include "materials/law.hpp"

namespace strut {

// Limit of the steepness of families with broken bonds, relative to an interior point: that of points at a corner,
// which have an eighth of the family. A steeper point carries no stress.
inline constexpr double steepness_of_corners = 8;

// The fraction of a strain jump that the stress follows, for linear elasticity: the λ from 0 to 1 that minimizes the
// energy W + λ σ:Δε + ½ λ² Δε:C:Δε.
double part_that_releases(const materials::Moduli& moduli, const Tensor& strain, const Tensor& jump);

}  // namespace strut
