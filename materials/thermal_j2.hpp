// J2 plasticity of a metal that is heated by its flow, adiabatically, with a flow stress that depends on temperature T:
//   ρ c_p Ṫ = β σ̄ ε̄̇ + viscous work     (the fraction β of the plastic work heats: Taylor & Quinney 1934)
//   μ = μ_r (1 − a (T − T_r)): the shear modulus decreases with temperature
// No heat flows between points, which is valid while √(κ t) is small compared with the hot region, κ the thermal
// diffusivity. Method: radial return at the temperature of the step's start; then heating, and the deviator follows its
// modulus. Units: Pa, 1/s, s, K.
#pragma once

#include <array>
#include <string_view>

#include "materials/j2.hpp"
#include "materials/thermal_flow.hpp"

namespace strut::materials {

inline constexpr double room_temperature = 293;  // K, unless a deck gives another one

struct Heating {
  double capacity = 0;                // ρ c_p of the reference state, J/(m³ K); 0: constant temperature
  double taylor_quinney = 1;          // β
  double initial = room_temperature;  // T₀, K
};

struct ThermalJ2 {
  double bulk = 0, shear = 0;  // K, μ_r, Pa
  ThermalFlow flow;
  Heating heating;
  double shear_fall = 0, shear_reference = room_temperature;  // a, 1/K; T_r, K
  static constexpr double least_shear = 0.1;                  // of μ_r

  template <class T>
  using StateOf = ThermalState<T>;
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 5> state_names{
      J2::state_names[0], J2::state_names[1], J2::state_names[2], "Temperature", "Mechanical_Threshold"};

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, ThermalState<T>& state) const {
    const T before = state.plastic_work;
    StressOf<T> result = flowed(step, stress, state);
    if (!(heating.capacity > 0)) return result;
    warm(rise(T(state.plastic_work - before), step.viscous_work), step.J, state, result);
    return result;
  }

  State virgin_state() const;
  double shear_modulus(const State& state) const { return shear * relative_shear(state.temperature); }
  Moduli moduli() const { return {bulk, shear * relative_shear(heating.initial)}; }  // heating only reduces it
  double elastic_energy(const Symmetric& stress, const State& state) const {
    return Elastic{bulk, shear_modulus(state)}.elastic_energy(stress);
  }
  double plastic_strain(const State& state) const { return state.equivalent_plastic_strain; }
  bool has_flowed(const State& state) const { return state.equivalent_plastic_strain > 0; }
  double dissipation(const State& state) const { return state.plastic_work; }
  // Rise in temperature, K, by plastic work and viscous heat, J per m³ of reference volume.
  template <class T>
  T rise(const T& plastic_work, const T& viscous_work) const {
    if (!(heating.capacity > 0)) return T{};
    return (heating.taylor_quinney * plastic_work + viscous_work) / heating.capacity;
  }
  double heat(const State& state) const { return heating.capacity * (state.temperature - heating.initial); }
  double flow_stress(const State& state) const;
  void set_initial_temperature(double to) { heating.initial = to; }

 private:
  template <class T>
  T relative_shear(const T& temperature) const {
    const T left = 1 - shear_fall * (temperature - shear_reference);
    return left > least_shear ? left : same<T>(least_shear);
  }

  template <class T>
  StressOf<T> flowed(const StepOf<T>& step, const SymmetricOf<T>& stress, ThermalState<T>& state) const {
    const T mu = shear_fall > 0 ? T(shear * relative_shear(state.temperature)) : same<T>(shear);
    return std::visit(
        [&](const auto& law) {
          const auto now = law.at(state, step.rate);
          const StressOf<T> result = RadialReturn<T, decltype(now)>(now, bulk, mu).step(step, stress, state);
          const T& strain = state.equivalent_plastic_strain;
          if constexpr (requires { now.threshold_at(strain); }) state.threshold = now.threshold_at(strain).value;
          return result;
        },
        flow);
  }

  template <class T>
  void warm(const T& by, const T& J, ThermalState<T>& state, StressOf<T>& result) const {
    const T warmer = state.temperature + by;
    result.converged = result.converged && is_finite(warmer);
    const T next = result.converged ? warmer : state.temperature;
    if (shear_fall > 0) follow_modulus(T(relative_shear(next) / relative_shear(state.temperature)), J, state, result);
    state.temperature = next;
  }

  // The elastic strain stays as the modulus decreases; the decrease of stored energy is dissipated.
  template <class T>
  void follow_modulus(const T& ratio, const T& J, ThermalState<T>& state, StressOf<T>& result) const {
    const SymmetricOf<T> s = deviator(result.stress);
    const T stored = double_dot(s, s) / (4 * shear * relative_shear(state.temperature));
    for (int k = 0; k < 6; ++k) result.stress[k] -= (1 - ratio) * s[k];
    state.plastic_work += J * stored * (1 - ratio);
  }
};

static_assert(Law<ThermalJ2> && takes_lanes<ThermalJ2>);

}  // namespace strut::materials
