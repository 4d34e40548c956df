// The work that a step does on a point, as the forces of the scheme do it: what laws count their dissipation against.
#pragma once

#include "base/math/tensors.hpp"
#include "materials/law.hpp"

namespace strut::materials {

// J at the start of the step: with e = d Δt = ΔU U_mid⁻¹ the stretches at its ends are (1 ∓ ½ e) U_mid.
double old_determinant(const PointStep& step);

// Per volume of the reference state, J/m³: ½ (P₀ + P₁) : ΔF, which is what the forces do on points that move evenly
// through the step. `before`, `after`: unrotated Cauchy stresses at its ends, Pa.
double step_work(const PointStep& step, double old_J, const Symmetric& before, const Symmetric& after);

}  // namespace strut::materials
