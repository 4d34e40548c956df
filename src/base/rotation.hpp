// The rotation of the material: the frame in which laws see their stress.
#pragma once

#include "base/tensors.hpp"

namespace strut {

// The polar rotation R of F = V R at the end of a step, from F there and R at the start: Flanagan & Taylor's (1987)
// condition that V stay symmetric, posed for the step instead of the instant. Their rate form
//   ω = w − [V − (tr V) I]⁻¹ z,  z_i = ε_ikj D_jm V_mk
// is integrated with V at the start and drifts by a term of first order in dt; the step form
//   [(tr V) I − V] θ = axial(F Rᵀ),  V = sym(F Rᵀ),
// is one Newton step towards the polar decomposition itself, so an error of one step is removed in the next. It costs
// the same, needs no velocity gradient, and is exact for a rigid rotation of any size below 90° a step.
Tensor updated_rotation(const Tensor& rotation, const Tensor& deformation_gradient);

}  // namespace strut
