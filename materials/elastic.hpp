// Hypoelastic isotropic law: Hooke's law between the rates of the unrotated Cauchy stress and of deformation.
//   σ̇ = λ tr(d) I + 2μ d,  λ = K − 2μ/3     (Flanagan & Taylor 1987: in the unrotated frame no further terms appear)
// d is constant over a step, so the update is exact. Trade-off: for large elastic strain a hypoelastic law has no
// stored energy, so the work on a closed path need not vanish; the strains of metals stay below a fraction of a
// percent. Units: Pa, 1/s, s.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/math/tensors.hpp"
#include "materials/law.hpp"

namespace strut::materials {

// The stress at the end of an elastic step. Written component by component, as in other laws: compilers keep such a
// loop in registers, while an Eigen expression of six doubles goes through memory at three times the cost.
template <class T, class Shear>
SymmetricOf<T> elastic_trial(const StepOf<T>& step, const SymmetricOf<T>& stress, double bulk, const Shear& shear) {
  const T shear_part = 2 * shear * step.dt;
  const T volume_part = (bulk - 2 * shear / 3) * step.dt * trace(step.rate);
  SymmetricOf<T> next;
  for (int k = 0; k < 3; ++k) next[k] = stress[k] + shear_part * step.rate[k] + volume_part;
  for (int k = 3; k < 6; ++k) next[k] = stress[k] + shear_part * step.rate[k];
  return next;
}

struct Elastic {
  double bulk = 0, shear = 0;  // Pa

  template <class T>
  struct StateOf {};
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 0> state_names{};

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>&) const {
    const SymmetricOf<T> next = elastic_trial(step, stress, bulk, shear);
    return {next, is_finite(T(next[0] + next[1] + next[2] + next[3] + next[4] + next[5]))};
  }

  Moduli moduli() const { return {bulk, shear}; }

  // ½ σ : C⁻¹ : σ, J per m³ of current volume.
  double elastic_energy(const Symmetric& stress, const State& = {}) const {
    const double p = trace(stress) / 3;
    const Symmetric s = deviator(stress);
    return p * p / (2 * bulk) + double_dot(s, s) / (4 * shear);
  }

  double dissipation(const State&) const { return 0; }
  double flow_stress(const State&) const { return std::numeric_limits<double>::infinity(); }
};

static_assert(Law<Elastic> && takes_lanes<Elastic>);

}  // namespace strut::materials
