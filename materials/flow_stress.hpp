// The flow stress of J2 plasticity, σ̄(ε̄, ε̇) = h(ε̄) r(ε̇): a hardening curve times a rate factor with r(0) = 1.
// Each is a plain struct with one call operator that gives the function and its derivative; a law holds one of each.
// Trade-off: hardening and rate do not interact in a product; in return all combinations exist, and the elastic check
// needs only the hardening curve. To add one: a struct here, and its name in the variant. T is double or RawLanes:
// points side by side (side_by_side.hpp). Units: Pa, s, strain -.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

#include "materials/side_by_side.hpp"

namespace strut::materials {

// Value and slope of a function of one variable.
template <class T>
struct Curve {
  T value, slope;
};

// ---- Hardening: (σ_y, ε̄) -> h and dh/dε̄; softens() is false only where h never falls below σ_y -------------------

struct NoHardening {
  template <class T>
  Curve<T> operator()(double yield_stress, const T&) const {
    return {same<T>(yield_stress), same<T>(0)};
  }
  bool softens() const { return false; }
};

// h = σ_y + H ε̄
struct LinearHardening {
  double modulus = 0;  // H, Pa
  template <class T>
  Curve<T> operator()(double yield_stress, const T& strain) const {
    return {yield_stress + modulus * strain, same<T>(modulus)};
  }
  bool softens() const { return modulus < 0; }
};

// h = σ_y (1 + ε̄/ε̄₀)^N     (Postek, Nowak & Pęcherski 2021, eq. 20, with N = 1/n)
// exp(N log(…)) instead of pow: half the time and as accurate, because N < 1 scales the error of log.
struct PowerHardening {
  double reference_strain = 0, exponent = 0;  // ε̄₀, N
  template <class T>
  Curve<T> operator()(double yield_stress, const T& strain) const {
    const T h = yield_stress * exp(exponent * log(1 + strain / reference_strain));
    return {h, h * exponent / (reference_strain + strain)};
  }
  bool softens() const { return exponent < 0; }
};

// h = σ_y + B ε̄^n     (Johnson & Cook 1983: A + B ε^n)
// For n < 1 the slope at 0 is infinite; below smallest_strain the curve is its chord from 0, so that the slope is
// finite and consistent with the value. No measured curve resolves a strain of 1e-9.
struct LudwikHardening {
  double modulus = 0, exponent = 0;  // B Pa, n
  static constexpr double smallest_strain = 1e-9;
  template <class T>
  Curve<T> operator()(double yield_stress, const T& strain) const {
    const T least = same<T>(smallest_strain), e = strain < least ? least : strain;
    const T secant = modulus * exp((exponent - 1) * log(e));
    return {yield_stress + secant * strain, strain < least ? secant : T(exponent * secant)};
  }
  bool softens() const { return modulus < 0; }
};

// h = σ_y + Q (1 − exp(−b ε̄))     (Voce 1948)
struct VoceHardening {
  double saturation = 0, rate = 0;  // Q Pa, b -
  template <class T>
  Curve<T> operator()(double yield_stress, const T& strain) const {
    const T left = saturation * exp(-rate * strain);
    return {yield_stress + saturation - left, rate * left};
  }
  bool softens() const { return saturation < 0; }
};

// h = σ_y (1 + ε̄/ε̄₀)^N/(1 + (ε̄/ε̄₁)²)     (Needleman & Tvergaard 1984, as Peridigm has it)
struct NeedlemanHardening {
  double reference_strain = 0, exponent = 0, softening_strain = 0;  // ε̄₀, N, ε̄₁
  template <class T>
  Curve<T> operator()(double yield_stress, const T& strain) const {
    const Curve<T> power = PowerHardening{reference_strain, exponent}(yield_stress, strain);
    const T part = strain / softening_strain, left = 1 / (1 + part * part);
    return {power.value * left, left * (power.slope - 2 * power.value * left * part / softening_strain)};
  }
  bool softens() const { return true; }
};

// Piecewise linear through (strains, stresses), constant beyond the last; strains increase strictly from 0. The table
// contains the yield stress (its first value). The slope at a kink is that of the piece to the right.
struct TableHardening {
  std::vector<double> strains, stresses;  // -, Pa
  Curve<RawLanes> operator()(double, const RawLanes& strain) const {
    Curve<RawLanes> curve;
    for (int l = 0; l < small::lane_count; ++l) {
      const auto [value, slope] = (*this)(0, strain[l]);
      curve.value[l] = value, curve.slope[l] = slope;
    }
    return curve;
  }
  Curve<double> operator()(double, double strain) const {
    const auto above = std::upper_bound(strains.begin(), strains.end(), strain) - strains.begin();
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above, 1) - 1);
    if (i + 1 == strains.size()) return {stresses[i], 0};
    const double slope = (stresses[i + 1] - stresses[i]) / (strains[i + 1] - strains[i]);
    return {stresses[i] + slope * (strain - strains[i]), slope};
  }
  bool softens() const { return true; }  // unknown without a search of the table
};

using Hardening = std::variant<NoHardening, LinearHardening, PowerHardening, LudwikHardening, VoceHardening,
                               NeedlemanHardening, TableHardening>;

// ---- Rate: ε̇ -> r and dr/dε̇; rate_at(r) is an ε̇ ≥ 0 at which the factor is r ≥ 1, infinity if it never is ---------

struct NoRate {
  template <class T>
  Curve<T> operator()(const T&) const {
    return {same<T>(1), same<T>(0)};
  }
  template <class T>
  T rate_at(const T&) const {
    return same<T>(std::numeric_limits<double>::infinity());
  }
};

// r = (1 + ε̇/ε̇₀)^M     (Postek, Nowak & Pęcherski 2021, eq. 20, with M = 1/m)
struct PowerRate {
  double reference_rate = 1, exponent = 0;  // ε̇₀ 1/s, M
  template <class T>
  Curve<T> operator()(const T& rate) const {
    const T r = exp(exponent * log(1 + rate / reference_rate));
    return {r, r * exponent / (reference_rate + rate)};
  }
  template <class T>
  T rate_at(const T& factor) const {
    return reference_rate * expm1(log(factor) / exponent);
  }
};

// r = 1 + C ln(max(ε̇/ε̇₀, 1))     (Johnson & Cook 1983)
struct JohnsonCookRate {
  double reference_rate = 1, coefficient = 0;  // ε̇₀ 1/s, C
  template <class T>
  Curve<T> operator()(const T& rate) const {
    const auto is_slow = rate <= reference_rate;  // false if the rate is NaN
    if constexpr (std::is_same_v<T, double>) {
      if (is_slow) return {1, 0};  // without a logarithm
    }
    const T r = 1 + coefficient * log(rate / reference_rate), slope = coefficient / rate;
    return {is_slow ? same<T>(1) : r, is_slow ? same<T>(0) : slope};
  }
  template <class T>
  T rate_at(const T& factor) const {
    return reference_rate * exp((factor - 1) / coefficient);
  }
};

// r = max(ε̇/ε̇₀, 1)^M     (Needleman & Tvergaard 1984, without the lower limit 1)
struct NeedlemanRate {
  double reference_rate = 1, exponent = 0;  // ε̇₀ 1/s, M
  template <class T>
  Curve<T> operator()(const T& rate) const {
    const auto is_slow = rate <= reference_rate;  // false if the rate is NaN
    const T r = exp(exponent * log(rate / reference_rate)), slope = exponent * r / rate;
    return {is_slow ? same<T>(1) : r, is_slow ? same<T>(0) : slope};
  }
  template <class T>
  T rate_at(const T& factor) const {
    return reference_rate * exp(log(factor) / exponent);
  }
};

using Rate = std::variant<NoRate, PowerRate, JohnsonCookRate, NeedlemanRate>;

struct FlowStress {
  double yield_stress = 0;  // σ_y, Pa; a table contains its own
  Hardening hardening;
  Rate rate;

  template <class T>
  struct Value {
    T stress, by_strain, by_rate;  // σ̄ Pa, ∂σ̄/∂ε̄ Pa, ∂σ̄/∂ε̇ Pa s
  };
  Value<double> operator()(double strain, double strain_rate) const { return at_rate(strain_rate, at_rest(strain)); }

  // σ̄(ε̄, 0) and its slope; a softening curve ends at zero.
  template <class T>
  Curve<T> at_rest(const T& strain) const {
    const Curve<T> h = std::visit([&](const auto& law) { return law(yield_stress, strain); }, hardening);
    const auto holds = !(h.value < 0);  // true for NaN, too
    return {holds ? h.value : same<T>(0), holds ? h.slope : same<T>(0)};
  }

  // σ̄(ε̄, ε̇) from the curve at rest.
  template <class T>
  Value<T> at_rate(const T& strain_rate, const Curve<T>& h) const {
    const Curve<T> r = std::visit([&](const auto& law) { return law(strain_rate); }, rate);
    return {h.value * r.value, h.slope * r.value, h.value * r.slope};
  }

  // A lower bound of the flow stress of this law: a test that needs no logarithm.
  double lower_bound() const {
    return std::visit([this](const auto& law) { return law.softens() ? 0 : yield_stress; }, hardening);
  }

  // The plastic strain rate at which the flow stress is `stress`, from the curve at rest.
  template <class T>
  T rate_at(const T& stress, const Curve<T>& at_rest) const {
    const T factor = stress / at_rest.value;
    return std::visit([&](const auto& law) { return law.rate_at(factor); }, rate);
  }
};

}  // namespace strut::materials
