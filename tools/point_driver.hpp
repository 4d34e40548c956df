// One material point, driven along a path of strain, of stress, or of some components of each: the same driver serves
// strut-point and the contract tests of the laws. Physics: logarithmic strain in the unrotated frame, U = exp ε, J =
// det U = exp(tr ε), d = Δε/Δt, which is ΔU U_mid⁻¹ to the order of Δε² if ε keeps its axes, as required by laws of
// finite stretch. Method: if stress is prescribed, Newton on the strain increments with a numerical tangent. Units: Pa,
// 1/s, s, strain -.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/math/tensors.hpp"
#include "materials/law.hpp"
#include "materials/spectral.hpp"

namespace strut::point {

// For each component xx yy zz xy yz zx: true if its stress is prescribed, false if its strain increment is.
using StressPrescribed = std::array<bool, 6>;

inline constexpr StressPrescribed all_strain{};
inline constexpr StressPrescribed all_stress{true, true, true, true, true, true};
inline constexpr StressPrescribed lateral_stress{false, true, true, false, false, false};  // a bar along x

template <materials::Law L>
class Driver {
 public:
  explicit Driver(L law) : state(materials::virgin_state_of(law)), law_(std::move(law)) {}

  double time = 0;
  Symmetric strain = Symmetric::Zero();  // logarithmic
  Symmetric stress = Symmetric::Zero();  // unrotated Cauchy
  typename L::State state;

  const L& law() const { return law_; }

  // One step of length dt (s). Prescribed stresses become those of `target`; the other strains grow by `increment`.
  // Returns false, and leaves the point unchanged, if no such step is found.
  bool advance(const Symmetric& increment, const Symmetric& target, const StressPrescribed& prescribed, double dt) {
    const Goal goal{prescribed, target};
    Symmetric trial = increment;
    for (int i = 0; i < 6; ++i) {
      if (prescribed[i]) trial[i] = last_rate_[i] * dt;
    }
    Outcome outcome = evaluate(trial, dt);
    for (int i = 0; i < most_iterations && outcome.converged; ++i) {
      if (goal.distance(outcome.stress) <= tolerance * scale(outcome.stress, target)) {
        commit(trial, outcome, dt);
        return true;
      }
      if (!improve(goal, dt, trial, outcome)) return false;
    }
    return false;
  }

  bool advance_strain(const Symmetric& increment, double dt) {
    return advance(increment, Symmetric::Zero(), all_strain, dt);
  }
  bool advance_uniaxial_strain(double increment, double dt) {
    return advance_strain(Symmetric{increment, 0, 0, 0, 0, 0}, dt);
  }
  bool advance_uniaxial_stress(double increment, double dt) {
    return advance(Symmetric{increment, 0, 0, 0, 0, 0}, Symmetric::Zero(), lateral_stress, dt);
  }
  bool advance_stress(const Symmetric& target, double dt) { return advance(Symmetric::Zero(), target, all_stress, dt); }

 private:
  // Relative to the scale of the stress. A law solves for its own stress to some 1e-12.
  static constexpr double tolerance = 1e-10;
  // Newton needs three to six, from a distant start some more.
  static constexpr int most_iterations = 50;

  using Matrix = Eigen::Matrix<double, 6, 6>;

  struct Outcome {
    Symmetric stress;
    typename L::State state;
    bool converged;
  };

  struct Goal {
    StressPrescribed prescribed;
    Symmetric target;

    Symmetric excess(const Symmetric& stress) const {  // 0 if the strain is given
      Symmetric r = Symmetric::Zero();
      for (int i = 0; i < 6; ++i) {
        if (prescribed[i]) r[i] = stress[i] - target[i];
      }
      return r;
    }
    double distance(const Symmetric& stress) const { return excess(stress).template lpNorm<Eigen::Infinity>(); }
  };

  // The scale of the stress in the step: at its start, prescribed at its end, and found there.
  double scale(const Symmetric& found, const Symmetric& target) const {
    return std::max(
        {stress.lpNorm<Eigen::Infinity>(), target.lpNorm<Eigen::Infinity>(), found.lpNorm<Eigen::Infinity>()});
  }

  Outcome evaluate(const Symmetric& increment, double dt) const {
    Outcome outcome{stress, state, true};
    const double J = std::exp(trace(strain + increment));
    const auto [next, converged] =
        law_.step({increment / dt, dt, J, materials::exponential(strain + increment)}, stress, outcome.state);
    outcome.stress = next;
    outcome.converged = converged && next.allFinite();
    return outcome;
  }

  // ∂σ/∂Δε by forward differences, with the rows of the unit matrix (times a modulus, for the pivots) for given
  // strains. The difference is small compared with the increment, over which the law curves, but at least changes a
  // metal's stress by some 100 Pa, far above its round-off.
  Matrix tangent(const Goal& goal, double dt, const Symmetric& increment, const Outcome& at) const {
    const double h = std::max(1e-6 * increment.lpNorm<Eigen::Infinity>(), 1e-9);
    Matrix K = law_.moduli().bulk * Matrix::Identity();
    for (int j = 0; j < 6; ++j) {
      Symmetric moved = increment;
      moved[j] += h;
      const Symmetric change = (evaluate(moved, dt).stress - at.stress) / h;
      for (int i = 0; i < 6; ++i) {
        if (goal.prescribed[i]) K(i, j) = change[i];
      }
    }
    return K;
  }

  // A Newton step, halved until it reduces the excess; false if no fraction of it does.
  bool improve(const Goal& goal, double dt, Symmetric& increment, Outcome& outcome) const {
    const Symmetric full = tangent(goal, dt, increment, outcome).fullPivLu().solve(-goal.excess(outcome.stress));
    if (!full.allFinite()) return false;
    const double before = goal.distance(outcome.stress);
    for (double fraction = 1; fraction > 1e-6; fraction /= 2) {
      const Symmetric moved = increment + fraction * full;
      const Outcome next = evaluate(moved, dt);
      if (next.converged && goal.distance(next.stress) < before) {
        increment = moved;
        outcome = next;
        return true;
      }
    }
    return false;
  }

  void commit(const Symmetric& increment, const Outcome& outcome, double dt) {
    time += dt;
    strain += increment;
    last_rate_ = increment / dt;
    stress = outcome.stress;
    state = outcome.state;
  }

  L law_;
  Symmetric last_rate_ = Symmetric::Zero();  // start of the next Newton iteration
};

}  // namespace strut::point
