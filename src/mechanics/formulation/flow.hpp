// Inside mechanics and for integrators: cells of quadratic correspondence whose metal begins to flow.
//
// As long as a cell is elastic, its fit has the smallest penalty on H: accurate, and as stiff as the strut. Flow lets
// strain gather in a hinge, which so steep a fit hinders: a strut three cells thick would bear 16 % too much
// (tests/reference, bench_limit_load). From the first flow on the fit has a larger one.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Where block.points[k] has flowed for the first time, its cell shares its change of volume from now on
// (shared_volume.hpp), and its motion is fitted anew. Its law points go on from the gradients that the new fit has at
// the present places; their stress stays. Returns whether it did.
bool begin_flow(Body& body, MaterialBlock& block, int k);

// Does so for all owned cells and returns whether any cell began to flow. Ghosts must be at their present places. Steps
// in time call the function above themselves; an equilibrium calls this one when it accepts a load step.
bool begin_flow(Body& body);

// As a body has been restored: the fits of the cells that have flowed.
void refit_flowed(Body& body);

}  // namespace strut
