// The flow stress of metals with temperature, σ̄(ε̄, ε̇, T). Each is a plain struct whose `at` gives, for the state and
// rate of deformation of a point, its flow stress in a step for the radial return. To add one: a struct, and its name
// in the variant. The temperature is that at the start of a step, in which metals heat by hundredths of a kelvin.
// Units: Pa, 1/s, K, strain -.
#pragma once

#include <cmath>
#include <limits>
#include <variant>

#include "materials/flow_stress.hpp"
#include "materials/radial_return.hpp"
#include "materials/side_by_side.hpp"

namespace strut::materials {

// The state of metals with temperature.
template <class T>
struct ThermalState : PlasticState<T> {
  T temperature{};  // K
  T threshold{};    // σ̂ of the mechanical threshold, Pa; 0 with other flow stresses
};

// Lower limit of rates, 1/s, where the logarithm of the rate would go to −∞.
inline constexpr double slowest_rate = 1e-3;

template <class T>
T power(const T& base, double exponent) {
  constexpr double least = std::numeric_limits<double>::min();
  return exp(T(exponent * log(base > least ? base : same<T>(least))));
}

// ---- Hardening, rate and softening, σ̄ = h(ε̄) r(ε̇) θ(T) ----

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

// The flow stress of Zerilli & Armstrong (J. Appl. Phys. 61, 1987):
//   σ̄ = σ_a + K ε̄^n + B ε̄^N exp(−C₃ T + C₄ T ln ε̇);  fcc: K = 0, N = ½;  bcc: N = 0
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

// The mechanical threshold stress of fcc metals (Follansbee & Kocks, Acta Metall. 36, 1988):
//   σ̄ = σ_a + S(ε̇, T) σ̂ μ(T)/μ₀,  S = (1 − (e/g₀ ln(ε̇₀/ε̇))^(1/q))^(1/p),  e = k T/(μ b³),  μ = μ₀ − D/(exp(T₀/T) − 1)
//   dσ̂/dε̄ = θ₀ (1 − tanh(α σ̂/σ̂_s)/tanh α),  θ₀ = a₀ + a₁ ln ε̇ + a₂ √ε̇,  σ̂_s = σ̂_s0 (ε̇/ε̇_s0)^(e/g_s0)
// The threshold σ̂ is a state variable; over a step it grows by two terms of its series, at the rate of deformation.
struct MechanicalThreshold {
  double athermal = 0, initial = 0;                                   // σ_a, σ̂ of an undeformed point, Pa
  double shear = 1, shear_fall = 0, shear_temperature = 1;            // μ₀, D, Pa; T₀, K
  double boltzmann = 0;                                               // k/b³, Pa/K
  double energy = 1, rate = 1, p = 1, q = 1;                          // g₀; ε̇₀, 1/s; p, q
  double slopes[3] = {0, 0, 0}, curvature = 1;                        // a₀, a₁ Pa, a₂ Pa √s; α
  double saturation = 1, saturation_energy = 1, saturation_rate = 1;  // σ̂_s0 Pa; g_s0; ε̇_s0, 1/s

  template <class T>
  struct Rest {
    T value, slope;                // of the flow stress at the slowest rate
    T threshold, threshold_slope;  // σ̂, dσ̂/dε̄
  };
  template <class T>
  struct At {
    const MechanicalThreshold& law;
    T strain, threshold, slope, bend;  // ε̄, σ̂, its slope and d(slope)/dσ̂ at the start of the step
    T stiffness, energy;               // μ/μ₀, e/g₀
    T slowest;                         // S at the slowest rate

    double lower_bound() const { return law.athermal; }
    Curve<T> threshold_at(const T& reached) const {
      const T grown = reached - strain, furthest = -1 / bend, within = grown < furthest ? grown : furthest;
      return {threshold + slope * within * (1 + 0.5 * bend * within), slope * (1 + bend * within)};
    }
    Rest<T> at_rest(const T& reached) const {
      const auto [value, growth] = threshold_at(reached);
      const T factor = slowest * stiffness;
      return {law.athermal + factor * value, factor * growth, value, growth};
    }
    FlowStress::Value<T> at_rate(const T& rate, const Rest<T>& at_rest) const {
      const Curve<T> S = law.activated(energy, rate);
      const T factor = S.value * stiffness;
      return {law.athermal + factor * at_rest.threshold, factor * at_rest.threshold_slope,
              S.slope * stiffness * at_rest.threshold};
    }
    T rate_at(const T&, const Rest<T>&) const { return same<T>(std::numeric_limits<double>::infinity()); }
  };

  // S and dS/dε̇.
  template <class T>
  Curve<T> activated(const T& relative_energy, const T& strain_rate) const {
    const auto is_slow = !(strain_rate > slowest_rate);
    const T within = is_slow ? same<T>(slowest_rate) : strain_rate;
    const T barrier = relative_energy * log(this->rate / within);  // 0 … 1: the barrier exists
    const auto is_fast = barrier <= 0, is_free = barrier >= 1;
    const T root = q == 1 ? barrier : power<T>(barrier, 1 / q), left = 1 - root, value = power<T>(left, 1 / p);
    const T slope = value / (p * left) * root / (q * barrier) * relative_energy / within;
    return {is_fast ? same<T>(1) : is_free ? T{} : value, is_slow || is_fast || is_free ? T{} : slope};
  }

  // dσ̂/dε̄, and its derivative by σ̂.
  template <class T>
  Curve<T> hardening(const T& threshold, const T& relative_energy, const SymmetricOf<T>& deformation_rate) const {
    const SymmetricOf<T> d = deviator(deformation_rate);
    const T equivalent = sqrt(T(double_dot(d, d) / 1.5));
    const T now = equivalent > slowest_rate ? equivalent : same<T>(slowest_rate), log_rate = log(now);
    constexpr double least = -40;  // of the exponent, so that σ̂_s is not 0: no 0/0
    const T exponent = relative_energy / saturation_energy * (log_rate - std::log(saturation_rate));
    const T limit = saturation * exp(exponent > least ? exponent : same<T>(least));
    const T steepest = slopes[0] + slopes[1] * log_rate + slopes[2] * sqrt(now);
    const T decay = exp(T(-2 * curvature * threshold / limit)), tanh = (1 - decay) / (1 + decay);
    const double end = std::tanh(curvature);
    return {steepest * (1 - tanh / end), -steepest * curvature * (1 - tanh * tanh) / (limit * end)};
  }

  template <class T>
  At<T> at(const ThermalState<T>& state, const SymmetricOf<T>& deformation_rate) const {
    const T& temperature = state.temperature;
    constexpr double least = 1e-3;  // far above the melting temperature the fit of μ falls below 0
    const T fitted = 1 - shear_fall / shear / (exp(T(shear_temperature / temperature)) - 1);
    const T stiffness = fitted > least ? fitted : same<T>(least);
    const T relative = boltzmann / shear * temperature / stiffness, barrier = relative / energy;
    const auto [slope, bend] = hardening(state.threshold, relative, deformation_rate);
    const T slowest = activated(barrier, T{}).value;
    return {*this, state.equivalent_plastic_strain, state.threshold, slope, bend, stiffness, barrier, slowest};
  }
};

using ThermalFlow = std::variant<SoftenedFlow, ZerilliArmstrong, MechanicalThreshold>;

}  // namespace strut::materials
