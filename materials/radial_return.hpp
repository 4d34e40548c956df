// The implicit radial return of J2 plasticity (Wilkins 1964; Simo & Hughes, Computational Inelasticity, 3.3) with any
// flow stress σ̄(ε̄, ε̇): the deviator of the elastic trial stress is scaled back so that
//   σ_trial − 3μ Δε̄ − σ̄(ε̄ + Δε̄, Δε̄/dt) = 0.
// Written once for one point and for several, one per SIMD lane. Trade-off: first order in the step where the direction
// of loading changes, exact where it does not; stable for any step, and the stress never exceeds the flow stress.
// Requirements on the flow stress (flow_stress.hpp has one):
//   lower_bound()         a lower bound of all values; needs no logarithm
//   at_rest(ε̄)            its `value` is σ̄ at zero rate
//   at_rate(ε̇, at_rest)   σ̄ and its derivatives by ε̄ and ε̇
//   rate_at(σ̄, at_rest)   a rate at which it is σ̄, or infinity
// Units: Pa, 1/s, s.
#pragma once

#include <utility>

#include "base/math/tensors.hpp"
#include "materials/elastic.hpp"
#include "materials/law.hpp"

namespace strut::materials {

template <class T>
struct PlasticState {
  T equivalent_plastic_strain{};  // ε̄ = ∫ √(2/3 ė_p:ė_p) dt
  T plastic_strain_rate{};        // of the last step, 1/s; 0 if it was elastic
  T plastic_work{};               // J per m³ of reference volume
};

template <class T, class FlowStress>
class RadialReturn {
 public:
  RadialReturn(const FlowStress& flow, double bulk, const T& shear) : flow_(flow), bulk_(bulk), shear_(shear) {}

  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, PlasticState<T>& state) const {
    const SymmetricOf<T> trial = elastic_trial(step, stress, bulk_, shear_);
    const SymmetricOf<T> s = deviator(trial);
    const T q2 = 1.5 * double_dot(s, s);  // σ_trial²
    const auto bound = flow_.lower_bound();
    if (!any(!(q2 <= bound * bound))) return elastic(trial, state);
    const Rest at_rest = flow_.at_rest(state.equivalent_plastic_strain);
    // Flow needs a stress above both the bound and the curve, which round-off may swap. NaN counts as flow: solve()
    // then reports that it has not converged.
    const MaskOf<T> flows = !(q2 <= bound * bound) && !(q2 <= at_rest.value * at_rest.value);
    if (!any(flows)) return elastic(trial, state);
    const T q = sqrt(q2);
    const Flowed f = solve(flows, q, at_rest, state, step.dt);
    const T rate = f.increment / step.dt, work = step.J * f.increment * mean_stress(stress, s, q, f.stress);
    const MaskOf<T> converged = f.converged && rate >= 0 && is_finite(T(rate + work)), changes = flows && converged;
    const T none{};
    state.equivalent_plastic_strain += changes ? f.increment : none;
    state.plastic_strain_rate = changes ? rate : flows ? state.plastic_strain_rate : none;
    state.plastic_work += changes ? work : none;
    return {returned(changes, trial, s, T(1 - f.stress / q)), converged || !flows};
  }

 private:
  using Rest = decltype(std::declval<const FlowStress&>().at_rest(T{}));

  static StressOf<T> elastic(const SymmetricOf<T>& trial, PlasticState<T>& state) {
    state.plastic_strain_rate = T{};
    return {trial, T{} == T{}};
  }

  // The trial stress; where it changes, minus the fraction `part` of its deviator s.
  static SymmetricOf<T> returned(const MaskOf<T>& changes, const SymmetricOf<T>& trial, const SymmetricOf<T>& s,
                                 const T& part) {
    SymmetricOf<T> stress;
    for (int k = 0; k < 6; ++k) stress[k] = changes ? T(trial[k] - part * s[k]) : trial[k];
    return stress;
  }

  struct Flowed {
    T increment, stress;  // Δε̄; σ̄ at the end of the step, Pa
    MaskOf<T> converged;
  };

  // Residual of the return relative to σ_trial: a few thousand times the round-off of the flow stress.
  static constexpr double tolerance = 1e-12;
  // A Newton step shorter than this fraction of Δε̄ is the last: it leaves an error of its square, 1e-12 again, in a
  // flow stress that is smooth (at a kink, 1e-6 of what the step adds to it), and saves an evaluation.
  static constexpr double last_step = 1e-6;
  // Newton needs 3 on average and 11 at worst; bisection alone reaches round-off in about 50.
  static constexpr int most_iterations = 100;

  // Δε̄ of the points that flow, by Newton, kept in a bracket that shrinks: the residual is ≥ 0 at its left end and ≤ 0
  // at its right end. A point that is done waits for those beside it.
  Flowed solve(const MaskOf<T>& flows, const T& q, const Rest& at_rest, const PlasticState<T>& state,
               const T& dt) const {
    const T& strain = state.equivalent_plastic_strain;
    const T modulus = 3 * shear_;
    T left{}, right = q / modulus;
    T x = warm_guess(q, at_rest, state, dt);
    const MaskOf<T> is_warm = x > left && x < right;
    if (any(flows && !is_warm)) x = is_warm ? x : cold_guess(q, at_rest, dt);
    Flowed result{T{}, q, T{} > T{}};
    MaskOf<T> open = flows;
    for (int i = 0; i < most_iterations; ++i) {
      const auto [stress, by_strain, by_rate] = flow_.at_rate(T(x / dt), flow_.at_rest(T(strain + x)));
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

  // If the last step flowed, too: Δε̄ by the flow stress linearized about it, σ̄(ε̄, ε̇_old) + ∂σ̄/∂ε̄ Δε̄ +
  // ∂σ̄/∂ε̇ (Δε̄/dt − ε̇_old). It follows a change of the rate at once; a guess by the last rate would lag behind.
  T warm_guess(const T& q, const Rest& at_rest, const PlasticState<T>& state, const T& dt) const {
    const T& rate = state.plastic_strain_rate;
    if (!any(rate > 0)) return T{};
    const auto [stress, by_strain, by_rate] = flow_.at_rate(rate, at_rest);
    const T guess = (q - stress + by_rate * rate) / (3 * shear_ + by_strain + by_rate / dt);
    return rate > 0 ? guess : T{};
  }

  // If the last step was elastic: the lesser of two upper bounds of Δε̄ (if the law does not soften): the flow that
  // lowers the stress to the flow stress at rest, and the flow at constant stress. From this side of the root a Newton
  // step on a concave flow stress does not leave the bracket.
  T cold_guess(const T& q, const Rest& at_rest, const T& dt) const {
    const T to_rest = (q - at_rest.value) / (3 * shear_), all = flow_.rate_at(q, at_rest) * dt;
    const T least = all < to_rest ? all : to_rest;
    return least < 0 ? T{} : least;  // lanes' sqrt may give a q one bit below the flow stress
  }

  // Replaces Newton iterates outside the bracket.
  static T fallback(const T& left, const T& right, const T& guess) {
    return guess > left && guess < right ? guess : T((left + right) / 2);
  }

  // The stress that does the plastic work of a step, ½(σ_old + σ_new) : (3/2) s_trial/σ_trial. With it ½(σ_old +
  // σ_new) : d dt = change of elastic energy + mean_stress Δε̄ holds to round-off (J = 1) whether or not the step
  // began below yield, so that the ledger of a run closes; σ̄ instead of s_old would count too much. If one step
  // crosses the whole yield surface while the rate decreases, it could become negative, which dissipation must
  // not.
  static T mean_stress(const SymmetricOf<T>& old, const SymmetricOf<T>& s, const T& q, const T& flow_stress) {
    const T mean = (flow_stress + 1.5 * double_dot(old, s) / q) / 2;
    return mean > 0 ? mean : T{};
  }

  const FlowStress& flow_;
  double bulk_;
  T shear_;
};

}  // namespace strut::materials
