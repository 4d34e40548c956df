// How stress follows the jump of the gradient at a point that loses bonds.
#pragma once

#include "base/math/tensors.hpp"
#include "materials/law.hpp"

namespace strut {

// Times that of a point inside of a block: what steepness broken families may have, as points at a corner do, where an
// eighth of the family is left. A steeper point carries no stress.
inline constexpr double steepness_of_corners = 8;

// The part of a jump of the strain that stress follows, from a strain of linear elasticity: to the least of the energy,
// W + λ σ:Δε + ½ λ² Δε:C:Δε, for λ from 0 to 1.
double part_that_releases(const materials::Moduli& moduli, const Tensor& strain, const Tensor& jump);

}  // namespace strut
