// J2 plasticity with the pressure of an equation of state, p(v, e), instead of Hooke's law: for shocks. The deviator is
// that of ThermalJ2; the energy is the work of stress and artificial viscosity.
//   ė = s : d v − (p + q) v̇,  Ṫ = … − Γ T v̇     (per reference volume; compression heats, too)
// Method: p at the end of a step enters the work of that step; both are linear in it, so it is solved for directly. v
// is integrated from the rates, so that integration points with the same change of volume have the same pressure.
// Units: Pa, J/m³, K.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "materials/flow_stress.hpp"
#include "materials/side_by_side.hpp"
#include "materials/thermal_j2.hpp"

namespace strut::materials {

// The pressure of a solid under shock, p(v, e) = p_c(v) + γ e, as a function of the relative volume v = ρ₀/ρ and the
// internal energy e (J per m³ of reference volume, 0 at rest). Each is a plain struct that gives p_c and its slope; γ
// is constant. To add one: a struct here, and its name in the variant. T is double or RawLanes. Units: Pa, J/m³.

// p = p_H (1 − Γ₀ x/2) + Γ₀ e,  p_H = ρ₀ c₀² x/(1 − s x)²,  x = 1 − v: around the Hugoniot U_s = c₀ + s u_p, with
// constant ρ Γ (Grüneisen 1912; Wilkins, Computer Simulation of Dynamic Phenomena, 3.7). In tension p_c = ρ₀ c₀² x.
struct MieGruneisen {
  double density = 1, sound = 1, slope = 0, gamma = 0;  // ρ₀ kg/m³, c₀ m/s, s, Γ₀
  static constexpr double least = 0.05;                 // of 1 − s x, which is 0 at the largest compression

  double energy_factor() const { return gamma; }
  double bulk() const { return density * sound * sound; }
  template <class T>
  Curve<T> cold(const T& volume) const {
    const T x = 1 - volume, left = 1 - slope * x, at_once = 1 - 0.5 * gamma * x;
    const T pressure = bulk() * x * at_once / (left * left);
    const T by_volume = -bulk() * ((1 - gamma * x) + 2 * slope * x * at_once / left) / (left * left);
    const auto is_tension = x < 0;
    return {is_tension ? T(bulk() * x) : pressure, is_tension ? same<T>(-bulk()) : by_volume};
  }
  template <class T>
  auto holds(const T& volume) const {
    return volume > 0 && 1 - slope * (1 - volume) > least;
  }
};

// p = K/n (v⁻ⁿ − 1)     (Murnaghan 1944; Tait's equation for a liquid)
struct Tait {
  double bulk_modulus = 1, exponent = 1;  // K Pa, n

  double energy_factor() const { return 0; }
  double bulk() const { return bulk_modulus; }
  template <class T>
  Curve<T> cold(const T& volume) const {
    const T grown = exp(T(-exponent * log(volume)));
    return {bulk_modulus / exponent * (grown - 1), -bulk_modulus * grown / volume};
  }
  template <class T>
  auto holds(const T& volume) const {
    return volume > 0;
  }
};

using EquationOfState = std::variant<MieGruneisen, Tait>;

struct ShockJ2 {
  ThermalJ2 metal;  // its bulk modulus is that of the equation of state at rest
  EquationOfState equation;

  template <class T>
  struct StateOf : ThermalState<T> {
    T volume = same<T>(1);  // v
    T energy{};             // e
    T stored{};             // elastic part of it, J per m³ of reference volume
  };
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 8> state_names{
      ThermalJ2::state_names[0], ThermalJ2::state_names[1], ThermalJ2::state_names[2], ThermalJ2::state_names[3],
      ThermalJ2::state_names[4], "Relative_Volume",         "Internal_Energy_Density", "Elastic_Energy_Density"};

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>& state) const {
    StateOf<T> next = state;
    const T grown = growth(step), volume = state.volume * grown, scale = step.J / volume;
    const T expanded = scale * (volume - state.volume);                 // per reference volume, as the forces do
    const T cooling = 0.5 * energy_factor() * (volume - state.volume);  // isentropic
    if (metal.heating.capacity > 0) next.temperature *= (1 - cooling) / (1 + cooling);
    StressOf<T> result = metal.step(step, stress, next);
    const SymmetricOf<T> old = deviator(stress), s = deviator(result.stress);
    const T shear_work =
        (step.J - 0.5 * expanded) * 0.5 * step.dt * (double_dot(old, step.rate) + double_dot(s, step.rate));
    const T before = -trace(stress) / 3;
    const T pressure = solved(volume, T(state.energy + step.viscous_work + shear_work), before, expanded);
    const T work = shear_work - 0.5 * (before + pressure) * expanded;
    next.volume = volume;
    next.energy = state.energy + work + step.viscous_work;
    next.stored = state.stored + work - (next.plastic_work - state.plastic_work);
    for (int k = 0; k < 3; ++k) result.stress[k] = s[k] - pressure;
    result.converged = result.converged && holds(volume) && is_finite(next.energy) && next.temperature >= 0;
    state = chosen(result.converged, next, state);
    return result;
  }

  State virgin_state() const;
  Moduli moduli() const { return metal.moduli(); }
  Moduli moduli(const State& state) const;
  double stored_energy(const State& state) const { return state.stored; }
  double elastic_energy(const Symmetric&, const State& state) const { return state.stored / state.volume; }
  double plastic_strain(const State& state) const { return state.equivalent_plastic_strain; }
  bool has_flowed(const State& state) const { return metal.has_flowed(state); }
  double dissipation(const State& state) const { return metal.dissipation(state); }
  double heat(const State& state) const { return metal.heat(state); }
  double flow_stress(const State& state) const { return metal.flow_stress(state); }
  void set_initial_temperature(double to) { metal.set_initial_temperature(to); }

 private:
  double energy_factor() const {
    return std::visit([](const auto& law) { return law.energy_factor(); }, equation);
  }
  template <class T>
  MaskOf<T> holds(const T& volume) const {
    return std::visit([&volume](const auto& law) -> MaskOf<T> { return law.holds(volume); }, equation);
  }

  // The ratio of the new to the old volume, det(1 + ½ d Δt)/det(1 − ½ d Δt).
  template <class T>
  static T growth(const StepOf<T>& step) {
    SymmetricOf<T> half;
    for (int k = 0; k < 6; ++k) half[k] = 0.5 * step.dt * step.rate[k];
    return determinant_of_one_and(half, 1) / determinant_of_one_and(half, -1);
  }
  template <class T, class S>
  static auto determinant_of_one_and(const S& h, const T& sign) {
    const auto x = 1 + sign * h[0], y = 1 + sign * h[1], z = 1 + sign * h[2];
    return x * y * z + 2 * sign * (h[3] * h[4] * h[5]) - x * h[4] * h[4] - y * h[5] * h[5] - z * h[3] * h[3];
  }

  // p = p_c(v) + γ (e − ½ (p_old + p) Δv); `energy`: e without the work of the pressure.
  template <class T>
  T solved(const T& volume, const T& energy, const T& before, const T& expanded) const {
    const T cold = std::visit([&volume](const auto& law) -> T { return law.cold(volume).value; }, equation);
    const double gamma = energy_factor();
    return (cold + gamma * (energy - 0.5 * before * expanded)) / (1 + 0.5 * gamma * expanded);
  }
};

static_assert(Law<ShockJ2> && takes_lanes<ShockJ2>);

}  // namespace strut::materials
