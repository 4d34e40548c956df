// A metal that flows as J2 does, and fails: from where its criterion is met, stress and stiffness in tension fall.
//   σ = x dev σ̃ + (x if σ̃_m > 0, else 1) σ̃_m I,   σ̃ by J2,   d = 1 − x     (Lemaitre's effective stress σ̃)
//   G_c/L d(1 − x²) = dissipation per volume from then on     (G_c over a length: Hillerborg, Modéer & Petersson 1976)
// With perfect plasticity the stress falls linearly with the plastic strain. However the metal hardens or is strained,
// it has dissipated G_c/L when x = 0, or more where its elastic energy W is: at x = W L/(2 G_c) that does the rest.
// Then it has failed, and carries no stress. In compression it closes at once. Method: J2's step on the effective
// stress, then a quadratic equation for x. Units: Pa, 1/s, s.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>
#include <variant>

#include "materials/failure_criterion.hpp"
#include "materials/j2.hpp"

namespace strut::materials {

struct Ductile {
  J2 metal;
  Ductility ductility;
  double length = 1;  // L over which a crack smears its opening, m

  template <class T>
  struct StateOf {
    typename J2::StateOf<T> metal;  // of a failed point, all that it held counts as plastic work
    T indicator{};                  // D of the criterion
    T damage{};                     // d
  };
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 5> state_names{
      J2::state_names[0], J2::state_names[1], J2::state_names[2], "Failure_Indicator", "Ductile_Damage"};

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>& state) const {
    const MaskOf<T> fails = state.indicator >= 1;
    if constexpr (std::is_same_v<T, double>) {
      return fails ? soften(step, stress, state) : flow(step, stress, state);
    } else {
      StateOf<T> next = state;
      StressOf<T> result = flow(step, stress, next);
      for (int l = 0; any(fails) && l < small::lane_count; ++l) {
        if (fails[l]) soften_lane(l, step, stress, state, next, result);
      }
      state = next;
      return result;
    }
  }

  Moduli moduli() const { return metal.moduli(); }
  Moduli moduli(const State& state) const { return state.damage < 1 ? metal.moduli() : Moduli{}; }
  double elastic_energy(const Symmetric& stress, const State& state) const {
    if (!(state.damage < 1)) return 0;
    const double mean = trace(stress) / 3, x = 1 - state.damage;
    const double whole = mean > 0 ? 0 : mean * mean / (2 * metal.bulk);
    const Symmetric rest = mean > 0 ? stress : deviator(stress);
    return whole + metal.elastic_energy(rest, {}) / x;
  }
  bool has_flowed(const State& state) const { return metal.has_flowed(state.metal); }
  double part_left(const State& state) const { return 1 - state.damage; }
  void set_crack_length(double to) { length = to; }
  double dissipation(const State& state) const { return metal.dissipation(state.metal); }
  double equivalent_stress(const Symmetric& stress, const State&) const { return von_mises(stress); }
  double flow_stress(const State& state) const {
    if (!(state.damage < 1)) return std::numeric_limits<double>::infinity();
    return (1 - state.damage) * metal.flow_stress(state.metal);
  }

 private:
  template <class T>
  StressOf<T> flow(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>& state) const {
    const T before = state.metal.equivalent_plastic_strain;
    const StressOf<T> result = metal.step(step, stress, state.metal);
    const T strain = state.metal.equivalent_plastic_strain - before;
    if (any(strain > 0)) {
      const T& rate = state.metal.plastic_strain_rate;
      const auto growth_of = [&](const auto& criterion) -> T { return criterion.growth(result.stress, rate); };
      const T growth = std::visit(growth_of, ductility.criterion);
      state.indicator += strain > 0 ? T(strain * growth) : T{};
    }
    return result;
  }

  // From where the criterion is met, point by point. Not inline: rare, and laws are inlined into every formulation.
  PointStress soften(const PointStep& step, const Symmetric& stress, State& state) const;
  double reduced(double x, double flowed, double elastic) const;
  void soften_lane(int l, const StepOf<RawLanes>& step, const SymmetricOf<RawLanes>& stress,
                   const StateOf<RawLanes>& state, StateOf<RawLanes>& next, StressOf<RawLanes>& result) const;
};

static_assert(Law<Ductile> && takes_lanes<Ductile>);

}  // namespace strut::materials
