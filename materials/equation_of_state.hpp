// The pressure of a solid under shock, p(v, e) = p_c(v) + γ e, as a function of the relative volume v = ρ₀/ρ and the
// internal energy e (J per m³ of reference volume, 0 at rest). Each is a plain struct that gives p_c and its slope; γ
// is constant. To add one: a struct here, and its name in the variant. T is double or RawLanes. Units: Pa, J/m³.
#pragma once

#include <variant>

#include "materials/flow_stress.hpp"
#include "materials/side_by_side.hpp"

namespace strut::materials {

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

}  // namespace strut::materials
