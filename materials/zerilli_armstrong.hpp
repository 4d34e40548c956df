// The flow stress of Zerilli & Armstrong (J. Appl. Phys. 61, 1987):
//   σ̄ = σ_a + K ε̄^n + B ε̄^N exp(−C₃ T + C₄ T ln ε̇);  fcc: K = 0, N = ½;  bcc: N = 0
// Units: Pa, 1/s, K, strain -.
#pragma once

#include <cmath>

#include "materials/flow_stress.hpp"
#include "materials/thermal_state.hpp"

namespace strut::materials {

struct ZerilliArmstrong {
  double athermal = 0;                       // σ_a, Pa
  LudwikHardening hardening, thermal;        // K, n; B, N
  double softening = 0, rate_softening = 0;  // C₃, C₄, 1/K

  template <class T>
  struct Rest {
    T value, slope;                  // of the flow stress at the slowest rate
    T thermal_value, thermal_slope;  // of its part that depends on rate and temperature
  };
  template <class T>
  struct At {
    const ZerilliArmstrong& law;
    T factor, exponent;  // the thermal part is B ε̄^N times factor (ε̇/slowest)^exponent

    double lower_bound() const { return law.athermal; }
    Rest<T> at_rest(const T& strain) const {
      const Curve<T> athermal =
          law.hardening.modulus > 0 ? law.hardening(law.athermal, strain) : Curve<T>{same<T>(law.athermal), T{}};
      const Curve<T> cold =
          law.thermal.exponent > 0 ? law.thermal(0, strain) : Curve<T>{same<T>(law.thermal.modulus), T{}};
      const T value = factor * cold.value, slope = factor * cold.slope;
      return {athermal.value + value, athermal.slope + slope, value, slope};
    }
    FlowStress::Value<T> at_rate(const T& rate, const Rest<T>& at_rest) const {
      const auto is_slow = rate <= slowest_rate;
      const T more = exp(T(exponent * log(rate / slowest_rate))) - 1, slope = (1 + more) * exponent / rate;
      const T grown = is_slow ? T{} : more;
      return {at_rest.value + at_rest.thermal_value * grown, at_rest.slope + at_rest.thermal_slope * grown,
              is_slow ? T{} : T(at_rest.thermal_value * slope)};
    }
    T rate_at(const T& stress, const Rest<T>& at_rest) const {
      return slowest_rate * exp(T(log(1 + (stress - at_rest.value) / at_rest.thermal_value) / exponent));
    }
  };
  template <class T>
  At<T> at(const ThermalState<T>& state, const SymmetricOf<T>&) const {
    const T exponent = rate_softening * state.temperature;
    return {*this, exp(T(exponent * std::log(slowest_rate) - softening * state.temperature)), exponent};
  }
};

}  // namespace strut::materials
