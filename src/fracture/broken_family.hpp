// A point that has lost bonds.
#pragma once

#include "fracture/point_account.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Computes anew what block.points[k] knows of its family: shape tensor and first moment, or the fit of its cell; of an
// ordinary point nothing. False where the bonds that are left cannot hold a deformation gradient, or only a steeper one
// than `most`: it is to be released.
bool refit(Body& body, MaterialBlock& block, int k, double most);

// The same as bonds break in a step; false also where the volume would jump by a factor of 2. The bonds that are left
// have another stretch than all. Stress follows this jump as long as its energy falls in that direction; the rest of
// the jump leaves it alone: a break releases energy, and where it leaves bonds in compression only, it must not make
// any.
bool refit_in_step(Body& body, MaterialBlock& block, int k, double most, const StepEnd& start);

// It carries no stress from now on, and goes on as a mass.
void release(Body& body, MaterialBlock& block, int k);

}  // namespace strut
