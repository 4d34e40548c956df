// Inside mechanics and for integrators: the onset of plastic flow in cells of quadratic correspondence.
//
// While a cell is elastic, its fit has the smallest penalty on H, which makes the stiffness accurate. In plastic flow,
// strain localizes in a hinge, which so steep a fit hinders: a strut three cells thick would bear 16 % too much
// (tests/reference, bench_limit_load). So from the first flow on the fit has a larger penalty.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// If block.points[k] has flowed for the first time, its integration points share their change of volume from now on
// (shared_volume.hpp), and its motion is fitted anew. They go on from the gradients of the new fit at the present
// positions; their stress stays. Returns true if flow began.
bool begin_flow(Body& body, MaterialBlock& block, int k);

// The same for all owned cells; returns true if any cell began to flow. Ghosts must be at their present positions. The
// stress update of an explicit step calls the function above for each cell; an equilibrium calls this one when it
// commits a load step.
bool begin_flow(Body& body);

// Refits the cells that have flowed, after a body has been restored from a checkpoint.
void refit_flowed(Body& body);

}  // namespace strut
