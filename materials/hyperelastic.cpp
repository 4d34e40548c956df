#include "materials/hyperelastic.hpp"

#include <algorithm>

#include "materials/spectral.hpp"
#include "materials/step_work.hpp"

namespace strut::materials {

namespace {

// Ogden's energy and stress without relaxation, at principal stretches.
struct Instant {
  double energy = 0;                  // of the change of shape, J/m³
  Vector deviator = Vector::Zero();   // dev τ₀, principal values, Pa
  Vector stiffness = Vector::Zero();  // ∂(dev τ₀)_i/∂ln λ_i, Pa
};

Instant instant(const Hyperelastic& law, const Vector& stretches, double J) {
  Instant found;
  for (const auto& [modulus, exponent] : law.terms) {
    if (modulus == 0) continue;
    const Vector logarithms = exponent * (stretches.array().log() - std::log(J) / 3);
    const Vector powers = logarithms.array().exp();
    const double mean = powers.sum() / 3;
    // The logarithms x sum to 0; subtracting each avoids cancellation at small strains.
    for (const double x : logarithms) found.energy += modulus / exponent * (std::expm1(x) - x);
    found.deviator += modulus * (powers - Vector::Constant(mean));
    found.stiffness += modulus * exponent / 3 * (powers + Vector::Constant(mean));
  }
  return found;
}

Symmetric congruent(const Tensor& A, const Symmetric& s) { return symmetric_part(A * to_tensor(s) * A); }

// The branches after a step: the sum of their deviators (Kirchhoff stress, Pa), and the work of their dampers (J/m³),
// each beside a spring of modulus γ_k G.
struct Branches {
  Symmetric carried = Symmetric::Zero();
  double damped = 0;
};

Branches moved_on(const Hyperelastic& law, const PointStep& step, const Symmetric& change, Hyperelastic::State& state) {
  const Tensor U = to_tensor(step.stretch);
  const double scale = 1 / std::cbrt(step.J * step.J);
  Branches sum;
  for (int k = 0; k < Hyperelastic::most_times; ++k) {
    const auto& [fraction, time] = law.times[k];
    if (fraction == 0) continue;
    Eigen::Map<Symmetric> branch(state.branches.data() + 6 * k);
    const Symmetric before = deviator(Symmetric(scale * congruent(U, branch)));
    branch = std::exp(-step.dt / time) * branch + std::exp(-0.5 * step.dt / time) * change;
    const Symmetric after = deviator(Symmetric(scale * congruent(U, branch))), middle = 0.5 * (before + after);
    sum.carried += fraction * after;
    sum.damped += fraction * double_dot(middle, middle) / (2 * law.shear()) * step.dt / time;
  }
  return sum;
}

}  // namespace

PointStress Hyperelastic::step(const PointStep& step, const Symmetric& stress, State& state) const {
  const Principal stretch = principal(step.stretch);
  if (!(step.J > 0) || !(stretch.values.minCoeff() > 0)) return {stress, false};
  const Instant now = instant(*this, stretch.values, step.J);
  const Symmetric fast = from_principal(now.deviator, stretch.axes);
  const double pressure = bulk * (step.J - 1);  // dU/dJ
  Symmetric kirchhoff = fast;
  State next = state;
  next.stored = now.energy + 0.5 * bulk * (step.J - 1) * (step.J - 1);
  const bool relaxes = kept() < 1;
  Branches branches;
  if (relaxes) {
    const Tensor inverse = to_tensor(step.stretch).inverse();
    const Symmetric reference = std::cbrt(step.J * step.J) * congruent(inverse, fast);
    const Symmetric change = reference - Eigen::Map<const Symmetric>(state.last.data());
    Eigen::Map<Symmetric>(next.last.data()) = reference;
    branches = moved_on(*this, step, change, next);
    kirchhoff = kept() * fast + branches.carried;
  }
  Symmetric cauchy = kirchhoff / step.J;
  cauchy.head<3>().array() += pressure;
  if (relaxes) {
    next.dissipated = state.dissipated + branches.damped;
    next.stored = state.stored + step_work(step, old_determinant(step), stress, cauchy) - branches.damped;
  }
  // ∂σ_i/∂ln λ_i of dev τ/J, where the second term stems from 1/J, and of the pressure.
  const Vector along = (now.stiffness - now.deviator) / step.J + Vector::Constant(bulk * step.J);
  next.stiffening = std::max(0.0, along.maxCoeff() / moduli().longitudinal() - 1);
  if (!std::isfinite(cauchy.sum() + next.stored + next.dissipated + next.stiffening)) return {stress, false};
  state = next;
  return {cauchy, true};
}

}  // namespace strut::materials
