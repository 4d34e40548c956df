// A metal that flows by J2, cold or hot, and fails: once its criterion is met, stress and stiffness in tension
// decrease.
//   σ = x dev σ̃ + (x if σ̃_m > 0, else 1) σ̃_m I,   σ̃ by J2,   d = 1 − x     (Lemaitre's effective stress σ̃)
//   G_c/L d(1 − x²) = dissipation per volume from then on     (G_c over a length: Hillerborg, Modéer & Petersson 1976)
// With perfect plasticity the stress decreases linearly with the plastic strain. For any hardening and loading, the
// metal has dissipated G_c/L when x = 0, or more if its elastic energy W exceeds that: from x = W L/(2 G_c) on W is
// enough. Then it has failed, and carries no stress; until then damage does not reduce a pressure. Method: J2's step on
// the effective stress, then a quadratic equation for x. Units: Pa, 1/s, s.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>
#include <variant>

#include "materials/failure_criterion.hpp"
#include "materials/j2.hpp"
#include "materials/softening.hpp"
#include "materials/thermal_j2.hpp"

namespace strut::materials {

template <class Metal>
struct DuctileOf {
  Metal metal;
  Ductility ductility;
  double length = 1;  // L over which a crack smears its opening, m

  template <class T>
  struct StateOf {
    typename Metal::template StateOf<T> metal;  // after failure, all energy that the point held counts as plastic work
    T indicator{};                              // D of the criterion
    T damage{};                                 // d
  };
  using State = StateOf<double>;
  static constexpr auto state_names = [] {
    std::array<std::string_view, state_size<Metal> + 2> names;
    std::copy(Metal::state_names.begin(), Metal::state_names.end(), names.begin());
    names[state_size<Metal>] = "Failure_Indicator", names[state_size<Metal> + 1] = "Ductile_Damage";
    return names;
  }();

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>& state) const {
    const MaskOf<T> fails = state.indicator >= 1;
    if constexpr (std::is_same_v<T, double>) {
      return fails ? soften(step, stress, state) : flow(step, stress, state);
    } else {
      StateOf<T> next = state;
      StressOf<T> result = flow(step, stress, next);
      if (any(fails)) soften_lanes(*this, fails, step, stress, state, next, result);
      state = next;
      return result;
    }
  }

  // The step of a point whose criterion is met.
  PointStress soften(const PointStep& step, const Symmetric& stress, State& state) const;

  State virgin_state() const { return {virgin_state_of(metal), 0, 0}; }
  Moduli moduli() const { return metal.moduli(); }
  Moduli moduli(const State& state) const { return state.damage < 1 ? metal.moduli() : Moduli{}; }
  double elastic_energy(const Symmetric& stress, const State& state) const {
    if (!(state.damage < 1)) return 0;
    const auto whole = [&](const Symmetric& part) { return metal.elastic_energy(part, state.metal); };
    return energy_of_softened(stress, 1 - state.damage, metal.bulk, whole);
  }
  double plastic_strain(const State& state) const { return metal.plastic_strain(state.metal); }
  bool has_flowed(const State& state) const { return metal.has_flowed(state.metal); }
  double part_left(const State& state) const { return 1 - state.damage; }
  void set_crack_length(double to) { length = to; }
  double dissipation(const State& state) const { return metal.dissipation(state.metal); }
  double heat(const State& state) const requires tells_heat<Metal> { return metal.heat(state.metal); }
  void set_initial_temperature(double to) requires tells_heat<Metal> { metal.set_initial_temperature(to); }
  double flow_stress(const State& state) const {
    if (!(state.damage < 1)) return std::numeric_limits<double>::infinity();
    return (1 - state.damage) * metal.flow_stress(state.metal);
  }

 private:
  template <class T>
  static T temperature_of(const typename Metal::template StateOf<T>& state) {
    if constexpr (tells_heat<Metal>) {
      return state.temperature;
    } else {
      return T{};
    }
  }

  template <class T>
  StressOf<T> flow(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>& state) const {
    const T before = state.metal.equivalent_plastic_strain;
    const StressOf<T> result = metal.step(step, stress, state.metal);
    const T strain = state.metal.equivalent_plastic_strain - before;
    if (any(strain > 0)) {
      const T& rate = state.metal.plastic_strain_rate;
      const T temperature = temperature_of(state.metal);
      const auto growth_of = [&](const auto& criterion) -> T {
        return criterion.growth(result.stress, rate, temperature);
      };
      const T growth = std::visit(growth_of, ductility.criterion);
      state.indicator += strain > 0 ? T(strain * growth) : T{};
    }
    return result;
  }

  double reduced(double x, double flowed, double elastic) const;
};

using Ductile = DuctileOf<J2>;
using ThermalDuctile = DuctileOf<ThermalJ2>;
static_assert(Law<Ductile> && takes_lanes<Ductile>);
static_assert(Law<ThermalDuctile> && takes_lanes<ThermalDuctile>);
extern template struct DuctileOf<J2>;
extern template struct DuctileOf<ThermalJ2>;

}  // namespace strut::materials
