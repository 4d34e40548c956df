// J2 plasticity with associated flow, isotropic hardening and rate dependence; hypoelastic below the flow stress.
//   ė_p = (3/2) ε̇ s/σ̄,  √(3/2 s:s) ≤ σ̄(ε̄, ε̇)     (Postek, Nowak & Pęcherski 2021, eqs. 18–20)
// Method: implicit radial return (Wilkins 1964; Simo & Hughes, Computational Inelasticity, 3.3). The deviator of the
// elastic trial stress is scaled back so that
//   σ_trial − 3μ Δε̄ − σ̄(ε̄ + Δε̄, Δε̄/dt) = 0.
// Trade-off: first order in the step where the direction of loading turns, exact where it does not; stable for any
// step, and the stress never lies above the flow stress. Units: Pa, 1/s, s.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/tensors.hpp"
#include "materials/elastic.hpp"
#include "materials/flow_stress.hpp"
#include "materials/law.hpp"

namespace strut::materials {

struct J2 {
  double bulk = 0, shear = 0;  // Pa
  FlowStress flow;

  struct State {
    double equivalent_plastic_strain = 0;  // ε̄ = ∫ √(2/3 ė_p:ė_p) dt
    double plastic_strain_rate = 0;        // of the last step, 1/s; 0 if it was elastic
    double plastic_work = 0;               // J per m³ of reference volume
  };
  static constexpr std::array<std::string_view, 3> state_names{
      "Equivalent_Plastic_Strain", "Equivalent_Plastic_Strain_Rate", "Plastic_Work_Density"};

  PointStress step(const PointStep& step, const Symmetric& stress, State& state) const {
    const Symmetric trial = Elastic{bulk, shear}.updated(step, stress);
    const Symmetric s = deviator(trial);
    const double q2 = 1.5 * double_dot(s, s);  // σ_trial²
    const double bound = flow.lower_bound();
    if (q2 <= bound * bound) return elastic(trial, state);
    const Curve at_rest = flow.at_rest(state.equivalent_plastic_strain);
    if (q2 <= at_rest.value * at_rest.value) return elastic(trial, state);
    // Here also with a NaN, of which no comparison is true.
    const double q = std::sqrt(q2);
    const Flow f = solve(q, at_rest, state, step.dt);
    const double rate = f.increment / step.dt;
    const double work = step.J * f.increment * mean_stress(stress, s, q, f.stress);
    if (!f.converged || !(rate >= 0) || !std::isfinite(rate + work)) return {trial, false};
    state.equivalent_plastic_strain += f.increment;
    state.plastic_strain_rate = rate;
    state.plastic_work += work;
    return {returned(trial, s, f.stress / q), true};
  }

  Moduli moduli() const { return {bulk, shear}; }
  double elastic_energy(const Symmetric& stress, const State&) const {
    return Elastic{bulk, shear}.elastic_energy(stress);
  }
  double dissipation(const State& state) const { return state.plastic_work; }
  double equivalent_stress(const Symmetric& stress, const State&) const { return von_mises(stress); }
  double flow_stress(const State& state) const {
    return flow(state.equivalent_plastic_strain, state.plastic_strain_rate).stress;
  }

 private:
  static PointStress elastic(const Symmetric& trial, State& state) {
    state.plastic_strain_rate = 0;
    return {trial, true};
  }

  // The trial stress with its deviator s scaled.
  static Symmetric returned(const Symmetric& trial, const Symmetric& s, double scale) {
    Symmetric stress;
    for (int k = 0; k < 6; ++k) stress[k] = trial[k] - (1 - scale) * s[k];
    return stress;
  }

  struct Flow {
    double increment, stress;  // Δε̄; σ̄ at the end of the step, Pa
    bool converged;
  };

  // Residual of the return relative to σ_trial: a few thousand times the round-off of the flow stress.
  static constexpr double tolerance = 1e-12;
  // A Newton step that is shorter than this part of Δε̄ is the last: it leaves an error of its square, 1e-12 again, in a
  // flow stress that is smooth (at a kink, 1e-6 of what the step adds to it), and saves an evaluation.
  static constexpr double last_step = 1e-6;
  // Newton needs 3 on average and 11 at worst; bisection alone reaches round-off in about 50.
  static constexpr int most_iterations = 100;

  // Δε̄ by Newton, kept in a bracket that shrinks: the residual is ≥ 0 at its left end and ≤ 0 at its right end.
  Flow solve(double q, const Curve& at_rest, const State& state, double dt) const {
    double left = 0, right = q / (3 * shear);
    double x = warm_guess(q, at_rest, state, dt);
    if (!(x > left && x < right)) x = cold_guess(q, at_rest, dt);
    for (int i = 0; i < most_iterations; ++i) {
      const auto [stress, by_strain, by_rate] = flow(state.equivalent_plastic_strain + x, x / dt);
      const double residual = q - 3 * shear * x - stress;
      if (std::abs(residual) <= tolerance * q) return {x, stress, true};
      if (!std::isfinite(residual)) break;
      (residual > 0 ? left : right) = x;
      const double next = x + residual / (3 * shear + by_strain + by_rate / dt);
      const bool inside = next > left && next < right;
      if (inside && std::abs(next - x) <= last_step * x) return {next, q - 3 * shear * next, true};
      x = inside ? next : fallback(left, right, cold_guess(q, at_rest, dt));
    }
    return {0, q, false};
  }

  // Flow went on: the flow stress linearised about the last step, σ̄(ε̄, ε̇_old) + ∂σ̄/∂ε̄ Δε̄ + ∂σ̄/∂ε̇ (Δε̄/dt − ε̇_old).
  // It follows a change of the rate at once, where the last rate itself as a guess would lag behind.
  double warm_guess(double q, const Curve& at_rest, const State& state, double dt) const {
    const double rate = state.plastic_strain_rate;
    if (!(rate > 0)) return 0;
    const auto [stress, by_strain, by_rate] = flow.at_rate(rate, at_rest);
    return (q - stress + by_rate * rate) / (3 * shear + by_strain + by_rate / dt);
  }

  // Flow begins: the lesser of two upper bounds (if the law does not soften), what flows if the stress falls to the
  // flow stress at rest and if it does not fall at all. From this side of the root a Newton step on a concave flow
  // stress does not leave the bracket.
  double cold_guess(double q, const Curve& at_rest, double dt) const {
    return std::min((q - at_rest.value) / (3 * shear), flow.rate_at(q, at_rest.value) * dt);
  }

  // Where Newton left the bracket.
  static double fallback(double left, double right, double guess) {
    return guess > left && guess < right ? guess : (left + right) / 2;
  }

  // The stress that does the plastic work of a step, ½(σ_old + σ_new) : (3/2) s_trial/σ_trial. With it
  //   ½(σ_old + σ_new) : d dt = change of elastic energy + mean_stress Δε̄
  // holds to round-off (J = 1) whether or not the step began below yield, so the ledger of a run closes; σ̄ in the place
  // of s_old would count more than was put in. Where one step crosses the whole yield surface while the rate falls it
  // could turn negative: dissipation does not.
  static double mean_stress(const Symmetric& old, const Symmetric& s, double q, double flow_stress) {
    return std::max(0.0, (flow_stress + 1.5 * double_dot(old, s) / q) / 2);
  }
};

static_assert(Law<J2>);

}  // namespace strut::materials
