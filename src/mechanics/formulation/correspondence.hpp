// Inside mechanics: correspondence, from the positions of a block's points to their force states.
#pragma once

#include "mechanics/formulation/stress_pass.hpp"

namespace strut {

void advance_stress(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                    StepReport& report);

// Sets the residuals Σ ω V |y_j − y_i − F ξ|² (m⁵) of the least-squares fit of F; on a lattice, from sums of squares.
void diagnose_residuals(Body& body, const LaneGroups& groups);

// Adds the springs on the residual of both ends' gradients to a point: their force, and what they take from A through
// F, ½ M K⁻¹. `own_force`: the force that the point's own state gives.
inline void add_residual(const Vector& force, const Tensor& moment, const Symmetric& shape_inverse,
                         const Vector& first_moment, ForceState& state, Vector& own_force) {
  const Tensor taken = 0.5 * moment * to_tensor(shape_inverse);
  for (int c = 0; c < 3; ++c) state.column[c].head<3>() -= taken.col(c).array();
  own_force += force - taken * first_moment;
}

}  // namespace strut
