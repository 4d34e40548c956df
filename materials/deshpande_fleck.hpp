// Deshpande and Fleck's metal foam: associated plastic flow that changes the volume, locking at a strain ε_D.
//   σ̂² = (σ_e² + α² σ_m²)/f ≤ Y(ε̂)²,  f = 1 + (α/3)²;  ε̇_p = ε̂̇ ∂σ̂/∂σ, so σ̂ ε̂̇ = σ : ε̇_p
//   Y = σ_p + γ e + α₂ ln(1/(1 − e^β)),  e = ε̂/ε_D
//     (Deshpande & Fleck 2000; Reyes, Hopperstad, Berstad, Hanssen & Langseth 2003)
// α = 0 is J2. Method: implicit return, one unknown Δε̂, by Newton within a bracket that ends at ε_D:
//   σ_m = σ_m*/(1 + K α² Δε̂/(f σ̂)),  σ_e = σ_e*/(1 + 3G Δε̂/(f σ̂)),  σ̂ = Y(ε̂ + Δε̂)
// Moduli may grow with plastic compaction from those of the foam to those of the solid; a step uses those at its start.
// A point whose volume has grown by a factor of exp(ε_cr) fails: it carries no stress from then on. Trade-off: first
// order in the step where the direction of flow changes. Units: Pa, 1/s, s.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/math/tensors.hpp"
#include "materials/elastic.hpp"
#include "materials/law.hpp"
#include "materials/step_work.hpp"

namespace strut::materials {

struct DeshpandeFleck {
  static constexpr double never = std::numeric_limits<double>::infinity();

  Moduli initial{}, compacted{};  // equal: the moduli are constant
  double alpha = 0;               // from the plastic Poisson's ratio: α² = (9/2)(1 − 2ν_p)/(1 + ν_p)
  double plateau = 0;             // σ_p, Pa
  double linear = 0;              // γ, Pa
  double locking = 0;             // α₂, Pa
  double exponent = 1;            // β
  double densification = never;   // ε_D
  double failure_strain = never;  // ε_cr, of ln J

  struct State {
    double equivalent_plastic_strain = 0;  // ε̂
    double volumetric_plastic_strain = 0;  // ∫ tr ε̇_p dt, negative where compacted
    double plastic_work = 0;               // J per m³ of reference volume; after failure, all that the point held
    double failed = 0;                     // 1 after failure
  };
  static constexpr std::array<std::string_view, 4> state_names{"Equivalent_Plastic_Strain", "Volumetric_Plastic_Strain",
                                                               "Plastic_Work_Density", "Failed"};

  PointStress step(const PointStep& step, const Symmetric& stress, State& state) const {
    if (state.failed > 0) return {Symmetric::Zero(), std::isfinite(step.J)};
    const Moduli now = moduli(state);
    const Symmetric trial = elastic_trial(step, stress, now.bulk, now.shear);
    const Invariants at{trace(trial) / 3, von_mises(trial)};
    const double equivalent = this->equivalent(at);
    if (!std::isfinite(equivalent + step.J)) return {trial, false};
    if (std::log(step.J) >= failure_strain) return fail(step, stress, state);
    if (equivalent <= hardening(state.equivalent_plastic_strain).stress) return {trial, true};
    const Flow flow = solve(at, equivalent, state.equivalent_plastic_strain, now);
    if (!flow.converged) return {trial, false};
    const Symmetric next = spherical(flow.mean * at.mean) + flow.deviatoric * deviator(trial);
    State reached = state;
    reached.equivalent_plastic_strain += flow.increment;
    reached.volumetric_plastic_strain += flow.increment * alpha * alpha * flow.mean * at.mean / (form() * flow.stress);
    reached.plastic_work += lost(step, stress, state, next, reached);
    if (!std::isfinite(reached.plastic_work)) return {trial, false};
    state = reached;
    return {next, true};
  }

  Moduli moduli() const { return initial; }
  // From `initial` to `compacted` in proportion to the plastic compaction; zero for a failed point.
  Moduli moduli(const State& state) const {
    if (state.failed > 0) return {};
    const double fraction = compaction(state);
    return {initial.bulk + fraction * (compacted.bulk - initial.bulk),
            initial.shear + fraction * (compacted.shear - initial.shear)};
  }
  double elastic_energy(const Symmetric& stress, const State& state) const {
    if (state.failed > 0) return 0;
    const Moduli now = moduli(state);
    return Elastic{now.bulk, now.shear}.elastic_energy(stress);
  }
  double plastic_strain(const State& state) const { return state.equivalent_plastic_strain; }
  double dissipation(const State& state) const { return state.plastic_work; }
  // Infinite for a point that has become solid.
  double flow_stress(const State& state) const {
    const bool is_solid = state.equivalent_plastic_strain >= (1 - 1e-9) * solid * densification;
    return is_solid ? never : hardening(state.equivalent_plastic_strain).stress;
  }

 private:
  struct Invariants {
    double mean, mises;  // σ_m, σ_e, Pa
  };

  // Fraction of ε_D above which a strain in double precision does not resolve Y to nine digits: the point is solid.
  static constexpr double solid = 1 - 1e-8;

  double form() const { return 1 + alpha * alpha / 9; }
  double equivalent(const Invariants& s) const {
    return std::sqrt((s.mises * s.mises + alpha * alpha * s.mean * s.mean) / form());
  }

  double compaction(const State& state) const {
    if (!(densification < never) || alpha == 0) return 0;
    const double full = 3 * alpha * alpha / (9 + alpha * alpha) * densification;  // ln(ρ_solid/ρ_foam)
    return std::clamp(-state.volumetric_plastic_strain / full, 0.0, 1.0);
  }

  struct Hardening {
    double stress, slope;  // Y, dY/dε̂; Pa
  };
  // Infinite from `solid` ε_D on, where the bracket of solve() ends.
  Hardening hardening(double strain) const {
    if (!(densification < never)) return {plateau, 0};
    const double e = strain / densification;
    if (!(e < solid)) return {never, 0};
    if (e <= 0) return {plateau, linear / densification};
    const double rest = -std::expm1(exponent * std::log(e));  // 1 − e^β
    return {plateau + linear * e - locking * std::log(rest),
            (linear + locking * exponent * (1 - rest) / (e * rest)) / densification};
  }

  struct Flow {
    double increment;         // Δε̂
    double stress;            // Y, Pa
    double mean, deviatoric;  // remaining fractions of the trial's parts
    bool converged;
  };

  // A residual of this fraction of the trial's σ̂ is the round-off of some hundred operations.
  static constexpr double tolerance = 1e-13;
  static constexpr int most_iterations = 200;  // bisection alone needs 60

  // The residual is σ̂ after the return less Y: positive at the left end of the bracket, negative at the right.
  Flow solve(const Invariants& trial, double equivalent, double strain, const Moduli& now) const {
    const double f = form(), per_mean = now.bulk * alpha * alpha / f, per_mises = 3 * now.shear / f;
    // The least stress per strain in any direction of flow, Pa; without the mean part if there is no volumetric flow.
    const double slowest = alpha > 0 ? std::min(per_mises, per_mean) : per_mises;
    double last_step = never, left = 0, right = std::min(solid * densification - strain, equivalent / slowest);
    double x = 0;
    for (int i = 0; i < most_iterations; ++i) {
      const Hardening Y = hardening(strain + x);
      const double ratio = x / Y.stress, mean = 1 / (1 + per_mean * ratio), mises = 1 / (1 + per_mises * ratio);
      const Invariants s{mean * trial.mean, mises * trial.mises};
      const double reached = this->equivalent(s), residual = reached - Y.stress;
      const double round_off = 4 * std::numeric_limits<double>::epsilon() * (strain + x);
      if (std::abs(residual) <= tolerance * equivalent || right - left <= round_off || last_step <= round_off) {
        return {x, Y.stress, mean, mises, true};
      }
      (residual > 0 ? left : right) = x;
      const double by_ratio =
          -(per_mises * mises * s.mises * s.mises + alpha * alpha * per_mean * mean * s.mean * s.mean) / (f * reached);
      const double slope = by_ratio * (1 - ratio * Y.slope) / Y.stress - Y.slope;
      const double next = x - residual / slope;
      const double safe = next > left && next < right ? next : (left + right) / 2;
      last_step = std::abs(safe - x);
      x = safe;
    }
    return {0, 0, 1, 1, false};
  }

  // Energy, J/m³, that the step does not store, as by growing moduli.
  double lost(const PointStep& step, const Symmetric& before, const State& old_state, const Symmetric& after,
              const State& state) const {
    return std::max(0.0, materials::lost(*this, step, old_determinant(step), before, old_state, after, state));
  }

  PointStress fail(const PointStep& step, const Symmetric& stress, State& state) const {
    State reached = state;
    reached.failed = 1;
    const Symmetric none = Symmetric::Zero();
    reached.plastic_work += lost(step, stress, state, none, reached);
    state = reached;
    return {none, true};
  }
};

static_assert(Law<DeshpandeFleck>);

}  // namespace strut::materials
