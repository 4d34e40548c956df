// The tangent of any law, for equilibrium solvers: ∂σ_c/∂U_d of the unrotated Cauchy stress at the end of a step;
// rows and columns xx yy zz xy yz zx, where an off-diagonal U_d changes together with its mirror image, and J with
// it.
#pragma once

#include <limits>

#include "base/math/small_tensors.hpp"
#include "materials/law.hpp"

namespace strut::materials {

// The step from one stretch to another, as in mechanics: d dt = sym(ΔU U_mid⁻¹).
inline PointStep step_between(const Symmetric& old_stretch, const Symmetric& stretch, double dt) {
  const Tensor U = to_tensor(stretch), old = to_tensor(old_stretch);
  const Symmetric rate = symmetric_part((U - old) * (0.5 * (U + old)).inverse()) / dt;
  return {rate, dt, U.determinant(), stretch};
}

// Half the width of a central difference, relative to the largest stretch. The truncation error is (h/ℓ)² of the
// tangent, where ℓ is the strain over which a law curves: at least the yield strain of a metal, 1e-3. The round-off
// error is 1e-16/h. Both are some 3e-9 at h³ = 1e-16 ℓ². Within h of the onset of flow it is a mean of both sides.
inline constexpr double difference_step = 5e-8;

template <class L>
StretchTangent difference_tangent(const L& law, const PointStep& step, const Symmetric& old_stress,
                                  const typename L::State& old_state, const Symmetric& old_stretch) {
  const auto stress_at = [&](const Symmetric& stretch) -> Symmetric {
    typename L::State state = old_state;
    const auto [stress, converged] = law.step(step_between(old_stretch, stretch, step.dt), old_stress, state);
    return converged ? stress : Symmetric(Symmetric::Constant(std::numeric_limits<double>::quiet_NaN()));
  };
  const double h = difference_step * step.stretch.template lpNorm<Eigen::Infinity>();
  StretchTangent tangent;
  for (int d = 0; d < 6; ++d) {
    Symmetric more = step.stretch, less = step.stretch;
    more[d] += h, less[d] -= h;
    tangent.col(d) = (stress_at(more) - stress_at(less)) / (more[d] - less[d]);  // not 2 h, which is rounded
  }
  return tangent;
}

// The law's own tangent if it has one, else by differences; `old_stretch`: U at the start of the step, which determines
// the rates.
template <class L>
StretchTangent tangent_of(const L& law, const PointStep& step, const Symmetric& old_stress,
                          const typename L::State& old_state, const Symmetric& old_stretch) {
  if constexpr (has_tangent<L>) {
    return law.tangent(step, old_stress, old_state);
  } else {
    return difference_tangent(law, step, old_stress, old_state, old_stretch);
  }
}

}  // namespace strut::materials
