// The rotation of the material: the frame in which laws see their stress.
#pragma once

#include "base/tensors.hpp"

namespace strut {

struct Polar {
  Tensor rotation;    // R
  Symmetric stretch;  // U
};

// The polar decomposition F = R U at the end of a step, from R at its start: Flanagan & Taylor's (1987) condition that
// the stretch stay symmetric, posed for the step instead of the instant. Their rate form
//   ω = w − [V − (tr V) I]⁻¹ z,  z_i = ε_ikj D_jm V_mk
// is integrated with V at the start and drifts by a term of first order in dt; the step form
//   [(tr S) I − S] θ = axial(R_nᵀ F),  S = sym(R_nᵀ F),  R = R_n exp(θ)
// is one Newton step towards the polar decomposition itself, so an error of one step is removed in the next. It costs
// the same, needs no velocity gradient, and is exact for a rigid rotation of any size below 90° a step.
Polar polar_update(const Tensor& old_rotation, const Tensor& deformation_gradient);

}  // namespace strut
