// A point whose bonds have broken.
#pragma once

#include "fracture/work_balance.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Recomputes the family sums of block.points[k]: shape tensor and first moment, or the fit of its cell; nothing for an
// ordinary point. Returns false if the intact bonds do not determine a deformation gradient or only one steeper than
// `most` (1/m²): the point must be released.
bool refit(Body& body, MaterialBlock& block, int k, double most);

// The same while bonds break in a step; also false if the volume would jump by a factor of 2. The stretch of the
// intact bonds differs from that of all bonds. Stress follows this jump as long as its energy decreases in that
// direction, and is kept over the rest: a break releases energy, and must not create any where only compressed bonds
// are left.
bool refit_in_step(Body& body, MaterialBlock& block, int k, double most, const StepEnd& start);

// The point carries no stress from now on, and keeps its mass.
void release(Body& body, MaterialBlock& block, int k);

}  // namespace strut
