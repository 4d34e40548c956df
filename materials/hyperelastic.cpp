#include "materials/hyperelastic.hpp"

#include <algorithm>

#include "materials/spectral.hpp"

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

// Stress and strain at a stretch, in the frame in which the branches relax.
struct Referred {
  Symmetric stress, strain;  // S̃₀, Pa; Ē = ½ (J^(−2/3) U² − 1)
  double energy = 0;         // without relaxation, J/m³
};

Referred referred(const Hyperelastic& law, const Tensor& U, double J, const Symmetric& fast, double energy) {
  const double scale = std::cbrt(J * J);
  return {scale * congruent(U.inverse(), fast), symmetric_part(0.5 * (U * U / scale - Tensor::Identity())),
          energy + 0.5 * law.bulk * (J - 1) * (J - 1)};
}

Referred at_start(const Hyperelastic& law, const Hyperelastic::State& state) {
  const Tensor U = Tensor::Identity() + to_tensor(Symmetric(state.last.data()));
  const Principal stretch = principal(symmetric_part(U));
  const double J = stretch.values.prod();
  const Instant then = instant(law, stretch.values, J);
  return referred(law, U, J, from_principal(then.deviator, stretch.axes), then.energy);
}

// The branches after a step: the sum of their deviators (Kirchhoff stress, Pa), Σ γ_k h_k at the middle of its start
// and end, and the work of their dampers (J/m³), each beside a spring of modulus γ_k `modulus`. Both energies are by
// this middle, as the work of the forces: closed forms add a work of one sign in each step of a vibration.
struct Branches {
  Symmetric carried = Symmetric::Zero(), middle = Symmetric::Zero();
  double damped = 0;
};

Branches moved_on(const Hyperelastic& law, const PointStep& step, const Symmetric& change, double modulus,
                  Hyperelastic::State& state) {
  const Tensor U = to_tensor(step.stretch);
  const double scale = 1 / std::cbrt(step.J * step.J);
  Branches sum;
  for (int k = 0; k < Hyperelastic::most_times; ++k) {
    const auto& [fraction, time] = law.times[k];
    if (fraction == 0) continue;
    const double x = step.dt / time;
    Eigen::Map<Symmetric> branch(state.branches.data() + 6 * k);
    const Symmetric start = branch;
    branch = std::exp(-x) * start - std::expm1(-x) / x * change;
    const Symmetric middle = 0.5 * (start + branch);
    const auto deviator_of = [&](const Symmetric& h) { return deviator(Symmetric(scale * congruent(U, h))); };
    const auto squared = [](const Symmetric& h) { return double_dot(h, h); };
    sum.carried += fraction * deviator_of(branch);
    sum.middle += fraction * middle;
    double damped = x * squared(deviator_of(middle));
    if (x > 1) {
      // The middle overstates a hold, whose stress falls far below it. A constant rate gives
      // h = steady + left exp(−t/t_k); its ∫ h:h dt/t_k is the second argument.
      const Symmetric steady = deviator_of(change / x), left = deviator_of(start) - steady;
      damped = std::min(damped, x * squared(steady) - 2 * std::expm1(-x) * double_dot(steady, left) -
                                    0.5 * std::expm1(-2 * x) * squared(left));
    }
    sum.damped += fraction * damped / (2 * modulus);
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
  if (kept() < 1) {
    const Tensor U = to_tensor(step.stretch);
    const Referred before = at_start(*this, state), after = referred(*this, U, step.J, fast, now.energy);
    Eigen::Map<Symmetric>(next.last.data()) = symmetric_part(U - Tensor::Identity());
    // A secant modulus, so that a branch which relaxes at a held stretch dissipates all that it stores.
    constexpr double measurable = 1e-16;  // strain², above which the energy has digits
    const double secant = now.energy > measurable * shear() ? double_dot(fast, fast) / (4 * now.energy) : shear();
    const Branches branches = moved_on(*this, step, after.stress - before.stress, secant, next);
    kirchhoff = kept() * fast + branches.carried;
    // The work of the instant law less ∫ Σ γ_k (S̃₀ − h_k) : dĒ, the part that relaxation has taken from its stress. The
    // first is exact, so that the balance of energy shows coarse load steps.
    const Symmetric relaxed = 0.5 * (1 - kept()) * (before.stress + after.stress) - branches.middle;
    const double work = after.energy - before.energy - double_dot(relaxed, after.strain - before.strain);
    next.dissipated = state.dissipated + branches.damped;
    next.stored = state.stored + work - branches.damped;
  }
  Symmetric cauchy = kirchhoff / step.J;
  cauchy.head<3>().array() += pressure;
  // ∂σ_i/∂ln λ_i of dev τ/J, where the second term stems from 1/J, and of the pressure.
  const Vector along = (now.stiffness - now.deviator) / step.J + Vector::Constant(bulk * step.J);
  next.stiffening = std::max(0.0, along.maxCoeff() / moduli().longitudinal() - 1);
  if (!std::isfinite(cauchy.sum() + next.stored + next.dissipated + next.stiffening)) return {stress, false};
  state = next;
  return {cauchy, true};
}

}  // namespace strut::materials
