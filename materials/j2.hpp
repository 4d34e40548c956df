// J2 plasticity with associated flow, isotropic hardening and rate dependence; hypoelastic below the flow stress.
//   ė_p = (3/2) ε̇ s/σ̄,  √(3/2 s:s) ≤ σ̄(ε̄, ε̇)     (Postek, Nowak & Pęcherski 2021, eqs. 18–20)
// Method: implicit radial return (Wilkins 1964; Simo & Hughes, Computational Inelasticity, 3.3). The deviator of the
// elastic trial stress is scaled back so that
//   σ_trial − 3μ Δε̄ − σ̄(ε̄ + Δε̄, Δε̄/dt) = 0.
// Written once for a point and for several points, one per SIMD lane.
// Trade-off: first order in the step where the direction of loading turns, exact where it does not; stable for any
// step, and the stress never lies above the flow stress. Units: Pa, 1/s, s.
#pragma once

#include <array>
#include <string_view>

#include "base/math/tensors.hpp"
#include "materials/elastic.hpp"
#include "materials/flow_stress.hpp"
#include "materials/law.hpp"

namespace strut::materials {

struct J2 {
  double bulk = 0, shear = 0;  // Pa
  FlowStress flow;

  template <class T>
  struct StateOf {
    T equivalent_plastic_strain{};  // ε̄ = ∫ √(2/3 ė_p:ė_p) dt
    T plastic_strain_rate{};        // of the last step, 1/s; 0 if it was elastic
    T plastic_work{};               // J per m³ of reference volume
  };
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 3> state_names{
      "Equivalent_Plastic_Strain", "Equivalent_Plastic_Strain_Rate", "Plastic_Work_Density"};

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>& state) const {
    const SymmetricOf<T> trial = Elastic{bulk, shear}.updated(step, stress);
    const SymmetricOf<T> s = deviator(trial);
    const T q2 = 1.5 * double_dot(s, s);  // σ_trial²
    const double bound = flow.lower_bound();
    if (!any(!(q2 <= bound * bound))) return elastic(trial, state);
    const Curve<T> at_rest = flow.at_rest(state.equivalent_plastic_strain);
    // Not below the bound and the curve, though round-off may put one over the other. Also with a NaN, of which no
    // comparison is true.
    const MaskOf<T> flows = !(q2 <= bound * bound) && !(q2 <= at_rest.value * at_rest.value);
    if (!any(flows)) return elastic(trial, state);
    const T q = sqrt(q2);
    const Flow<T> f = solve(flows, q, at_rest, state, step.dt);
    const T rate = f.increment / step.dt, work = step.J * f.increment * mean_stress(stress, s, q, f.stress);
    const MaskOf<T> converged = f.converged && rate >= 0 && is_finite(T(rate + work)), changes = flows && converged;
    const T none{};
    state.equivalent_plastic_strain += changes ? f.increment : none;
    state.plastic_strain_rate = changes ? rate : flows ? state.plastic_strain_rate : none;
    state.plastic_work += changes ? work : none;
    return {returned(changes, trial, s, T(1 - f.stress / q)), converged || !flows};
  }

  Moduli moduli() const { return {bulk, shear}; }
  double elastic_energy(const Symmetric& stress, const State&) const {
    return Elastic{bulk, shear}.elastic_energy(stress);
  }
  bool has_flowed(const State& state) const { return state.equivalent_plastic_strain > 0; }
  double dissipation(const State& state) const { return state.plastic_work; }
  double equivalent_stress(const Symmetric& stress, const State&) const { return von_mises(stress); }
  double flow_stress(const State& state) const {
    return flow(state.equivalent_plastic_strain, state.plastic_strain_rate).stress;
  }

 private:
  template <class T>
  static StressOf<T> elastic(const SymmetricOf<T>& trial, StateOf<T>& state) {
    state.plastic_strain_rate = T{};
    return {trial, T{} == T{}};
  }

  // The trial stress, where it changes less so much of its deviator s.
  template <class T>
  static SymmetricOf<T> returned(const MaskOf<T>& changes, const SymmetricOf<T>& trial, const SymmetricOf<T>& s,
                                 const T& part) {
    SymmetricOf<T> stress;
    for (int k = 0; k < 6; ++k) stress[k] = changes ? T(trial[k] - part * s[k]) : trial[k];
    return stress;
  }

  template <class T>
  struct Flow {
    T increment, stress;  // Δε̄; σ̄ at the end of the step, Pa
    MaskOf<T> converged;
  };

  // Residual of the return relative to σ_trial: a few thousand times the round-off of the flow stress.
  static constexpr double tolerance = 1e-12;
  // A Newton step that is shorter than this part of Δε̄ is the last: it leaves an error of its square, 1e-12 again, in a
  // flow stress that is smooth (at a kink, 1e-6 of what the step adds to it), and saves an evaluation.
  static constexpr double last_step = 1e-6;
  // Newton needs 3 on average and 11 at worst; bisection alone reaches round-off in about 50.
  static constexpr int most_iterations = 100;

  // Δε̄ of the points that flow, by Newton, kept in a bracket that shrinks: the residual is ≥ 0 at its left end and ≤ 0
  // at its right end. A point that is done waits for those beside it.
  template <class T>
  Flow<T> solve(const MaskOf<T>& flows, const T& q, const Curve<T>& at_rest, const StateOf<T>& state,
                const T& dt) const {
    const T& strain = state.equivalent_plastic_strain;
    const T modulus = same<T>(3 * shear);
    T left{}, right = q / modulus;
    T x = warm_guess(q, at_rest, state, dt);
    const MaskOf<T> is_warm = x > left && x < right;
    if (any(flows && !is_warm)) x = is_warm ? x : cold_guess(q, at_rest, dt);
    Flow<T> result{T{}, q, T{} > T{}};
    MaskOf<T> open = flows;
    for (int i = 0; i < most_iterations; ++i) {
      const auto [stress, by_strain, by_rate] = flow.at_rate(T(x / dt), flow.at_rest(T(strain + x)));
      const T residual = q - modulus * x - stress;
      const T next = x + residual / (modulus + by_strain + by_rate / dt);
      left = residual > 0 ? x : left;
      right = residual > 0 ? right : x;
      const MaskOf<T> is_root = absolute(residual) <= tolerance * q, inside = next > left && next < right;
      const MaskOf<T> found = open && (is_root || (inside && absolute(T(next - x)) <= last_step * x));
      result.increment = found ? (is_root ? x : next) : result.increment;
      result.stress = found ? (is_root ? stress : T(q - modulus * next)) : result.stress;
      result.converged = result.converged || found;
      open = open && !found && is_finite(residual);
      if (!any(open)) break;
      x = inside ? next : x;
      if (any(open && !inside)) x = inside ? x : fallback(left, right, cold_guess(q, at_rest, dt));
    }
    return result;
  }

  // Flow went on: the flow stress linearized about the last step, σ̄(ε̄, ε̇_old) + ∂σ̄/∂ε̄ Δε̄ + ∂σ̄/∂ε̇ (Δε̄/dt − ε̇_old).
  // It follows a change of the rate at once, where the last rate itself as a guess would lag behind.
  template <class T>
  T warm_guess(const T& q, const Curve<T>& at_rest, const StateOf<T>& state, const T& dt) const {
    const T& rate = state.plastic_strain_rate;
    if (!any(rate > 0)) return T{};
    const auto [stress, by_strain, by_rate] = flow.at_rate(rate, at_rest);
    const T guess = (q - stress + by_rate * rate) / (3 * shear + by_strain + by_rate / dt);
    return rate > 0 ? guess : T{};
  }

  // Flow begins: the lesser of two upper bounds (if the law does not soften), what flows if the stress falls to the
  // flow stress at rest and if it does not fall at all. From this side of the root a Newton step on a concave flow
  // stress does not leave the bracket.
  template <class T>
  T cold_guess(const T& q, const Curve<T>& at_rest, const T& dt) const {
    const T to_rest = (q - at_rest.value) / (3 * shear), all = flow.rate_at(q, at_rest.value) * dt;
    return all < to_rest ? all : to_rest;
  }

  // Where Newton left the bracket.
  template <class T>
  static T fallback(const T& left, const T& right, const T& guess) {
    return guess > left && guess < right ? guess : T((left + right) / 2);
  }

  // The stress that does the plastic work of a step, ½(σ_old + σ_new) : (3/2) s_trial/σ_trial. With it
  //   ½(σ_old + σ_new) : d dt = change of elastic energy + mean_stress Δε̄
  // holds to round-off (J = 1) whether or not the step began below yield, so the ledger of a run closes; σ̄ in the place
  // of s_old would count more than was put in. Where one step crosses the whole yield surface while the rate falls it
  // could turn negative: dissipation does not.
  template <class T>
  static T mean_stress(const SymmetricOf<T>& old, const SymmetricOf<T>& s, const T& q, const T& flow_stress) {
    const T mean = (flow_stress + 1.5 * double_dot(old, s) / q) / 2;
    return mean > 0 ? mean : T{};
  }
};

static_assert(Law<J2> && takes_lanes<J2>);

}  // namespace strut::materials
