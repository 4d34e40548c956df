// The flow stress of metals with temperature, σ̄(ε̄, ε̇, T). Each is a plain struct whose `at` gives, for the state and
// rate of deformation of a point, its flow stress in a step for the radial return. To add one: a struct in a file of
// its own, and its name in the variant. The temperature is that at the start of a step, in which metals heat by
// hundredths of a kelvin. Here: hardening, rate and softening, σ̄ = h(ε̄) r(ε̇) θ(T). Units: Pa, 1/s, K, strain -.
#pragma once

#include <variant>

#include "materials/flow_stress.hpp"
#include "materials/mechanical_threshold.hpp"
#include "materials/thermal_state.hpp"
#include "materials/zerilli_armstrong.hpp"

namespace strut::materials {

struct NoSoftening {
  template <class T>
  T operator()(const T&) const {
    return same<T>(1);
  }
};

// θ = 1 − T*^m,  T* = (T − T_r)/(T_m − T_r) between 0 and 1     (Johnson & Cook 1983)
struct JohnsonCookSoftening {
  double reference = 0, melting = 1, exponent = 1;  // T_r, T_m K; m
  template <class T>
  T operator()(const T& temperature) const {
    const T relative = (temperature - reference) / (melting - reference);
    const T solid = 1 - power<T>(relative, exponent);
    return relative > 0 ? (relative < 1 ? solid : T{}) : same<T>(1);
  }
};

using Softening = std::variant<NoSoftening, JohnsonCookSoftening>;

struct SoftenedFlow {
  FlowStress cold;
  Softening softening;

  template <class T>
  struct At {
    const FlowStress& cold;
    T factor;  // θ

    T lower_bound() const { return factor * cold.lower_bound(); }
    Curve<T> at_rest(const T& strain) const {
      const Curve<T> h = cold.at_rest(strain);
      return {factor * h.value, factor * h.slope};
    }
    auto at_rate(const T& rate, const Curve<T>& at_rest) const { return cold.at_rate(rate, at_rest); }
    T rate_at(const T& stress, const Curve<T>& at_rest) const { return cold.rate_at(stress, at_rest); }
  };
  template <class T>
  At<T> at(const ThermalState<T>& state, const SymmetricOf<T>&) const {
    const auto factor_of = [&state](const auto& law) -> T { return law(state.temperature); };
    return {cold, std::visit(factor_of, softening)};
  }
};

using ThermalFlow = std::variant<SoftenedFlow, ZerilliArmstrong, MechanicalThreshold>;

}  // namespace strut::materials
