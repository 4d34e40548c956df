// Inside mechanics: correspondence, from the places of the points of a block to the force state of each.
#pragma once

#include "mechanics/formulation/stress_pass.hpp"

namespace strut {

void advance_stress(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                    StepReport& report);

// Σ ω V |y_j − y_i − F ξ|², the least-squares residual of F; on a lattice from its squares.
void diagnose_residuals(Body& body, const LaneGroups& groups);

// Adds the springs on the residual of both ends' gradients to a point: their force, and what they take from A by way of
// F, ½ M K⁻¹. `own_force`: what the point's own state gives to the force on it.
inline void add_residual(const Vector& force, const Tensor& moment, const Symmetric& shape_inverse,
                         const Vector& first_moment, ForceState& state, Vector& own_force) {
  const Tensor taken = 0.5 * moment * to_tensor(shape_inverse);
  for (int c = 0; c < 3; ++c) state.column[c].head<3>() -= taken.col(c).array();
  own_force += force - taken * first_moment;
}

}  // namespace strut
