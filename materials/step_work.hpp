// The work of a step at a point, consistent with the forces of the scheme: laws derive their dissipation from it.
#pragma once

#include "base/math/tensors.hpp"
#include "materials/law.hpp"

namespace strut::materials {

// J at the start of the step: with e = d Δt = ΔU U_mid⁻¹ the stretches at start and end are (1 ∓ ½ e) U_mid.
double old_determinant(const PointStep& step);

// Per volume of the reference state, J/m³: ½ (P₀ + P₁) : ΔF, the work of the forces on points that move uniformly
// through the step. `before`, `after`: unrotated Cauchy stresses at its ends, Pa.
double step_work(const PointStep& step, double old_J, const Symmetric& before, const Symmetric& after);

// The part of the work of a step that a law does not store.
template <class L>
double lost(const L& law, const PointStep& step, double old_J, const Symmetric& before,
            const typename L::State& old_state, const Symmetric& after, const typename L::State& state) {
  const double stored_more = step.J * law.elastic_energy(after, state) - old_J * law.elastic_energy(before, old_state);
  return step_work(step, old_J, before, after) - stored_more;
}

}  // namespace strut::materials
