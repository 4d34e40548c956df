// The flow stress of J2 plasticity, σ̄(ε̄, ε̇) = h(ε̄) r(ε̇): a hardening curve times a rate factor with r(0) = 1.
// Each is a plain value with one call operator that gives the function and its derivative; a law holds one of each.
// Trade-off: a product, so hardening and rate do not interact; in return every combination is there, and the elastic
// check needs the hardening curve only. To add one: a struct here and its word in the variant. Units: Pa, s, strain -.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

namespace strut::materials {

// A function of one variable at one place.
struct Curve {
  double value, slope;
};

// ---- Hardening: (σ_y, ε̄) -> h and dh/dε̄; softens() is false only where h never falls below σ_y -------------------

struct NoHardening {
  Curve operator()(double yield_stress, double) const { return {yield_stress, 0}; }
  bool softens() const { return false; }
};

// h = σ_y + H ε̄
struct LinearHardening {
  double modulus = 0;  // H, Pa
  Curve operator()(double yield_stress, double strain) const { return {yield_stress + modulus * strain, modulus}; }
  bool softens() const { return modulus < 0; }
};

// h = σ_y (1 + ε̄/ε̄₀)^N     (Postek, Nowak & Pęcherski 2021, eq. 20, with N = 1/n)
// exp(N log(…)) rather than pow: half the time, and as good: the error of log is scaled by N < 1.
struct PowerHardening {
  double reference_strain = 0, exponent = 0;  // ε̄₀, N
  Curve operator()(double yield_stress, double strain) const {
    const double h = yield_stress * std::exp(exponent * std::log(1 + strain / reference_strain));
    return {h, h * exponent / (reference_strain + strain)};
  }
  bool softens() const { return exponent < 0; }
};

// h = σ_y + B ε̄^n     (Johnson & Cook 1983: A + B ε^n)
// For n < 1 the slope at 0 is infinite; below smallest_strain the curve is its chord from 0, so that the slope is
// finite and belongs to the value. No measured curve resolves a strain of 1e-9.
struct LudwikHardening {
  double modulus = 0, exponent = 0;  // B Pa, n
  static constexpr double smallest_strain = 1e-9;
  Curve operator()(double yield_stress, double strain) const {
    const double e = std::max(strain, smallest_strain);
    const double secant = modulus * std::exp((exponent - 1) * std::log(e));
    return {yield_stress + secant * strain, strain < smallest_strain ? secant : exponent * secant};
  }
  bool softens() const { return modulus < 0; }
};

// h = σ_y + Q (1 − exp(−b ε̄))     (Voce 1948)
struct VoceHardening {
  double saturation = 0, rate = 0;  // Q Pa, b -
  Curve operator()(double yield_stress, double strain) const {
    const double left = saturation * std::exp(-rate * strain);
    return {yield_stress + saturation - left, rate * left};
  }
  bool softens() const { return saturation < 0; }
};

// Piecewise linear through (strains, stresses), constant beyond the last; strains rise strictly from 0. The table holds
// the yield stress itself (its first value). The slope at a kink is that of the piece to the right.
struct TableHardening {
  std::vector<double> strains, stresses;  // -, Pa
  Curve operator()(double, double strain) const {
    const auto above = std::upper_bound(strains.begin(), strains.end(), strain) - strains.begin();
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above, 1) - 1);
    if (i + 1 == strains.size()) return {stresses[i], 0};
    const double slope = (stresses[i + 1] - stresses[i]) / (strains[i + 1] - strains[i]);
    return {stresses[i] + slope * (strain - strains[i]), slope};
  }
  bool softens() const { return true; }  // not known without looking through the table
};

using Hardening =
    std::variant<NoHardening, LinearHardening, PowerHardening, LudwikHardening, VoceHardening, TableHardening>;

// ---- Rate: ε̇ -> r and dr/dε̇; rate_at(r) is an ε̇ ≥ 0 at which the factor is r ≥ 1, infinity if it never is ---------

struct NoRate {
  Curve operator()(double) const { return {1, 0}; }
  double rate_at(double) const { return std::numeric_limits<double>::infinity(); }
};

// r = (1 + ε̇/ε̇₀)^M     (Postek, Nowak & Pęcherski 2021, eq. 20, with M = 1/m)
struct PowerRate {
  double reference_rate = 1, exponent = 0;  // ε̇₀ 1/s, M
  Curve operator()(double rate) const {
    const double r = std::exp(exponent * std::log(1 + rate / reference_rate));
    return {r, r * exponent / (reference_rate + rate)};
  }
  double rate_at(double factor) const { return reference_rate * std::expm1(std::log(factor) / exponent); }
};

// r = 1 + C ln(max(ε̇/ε̇₀, 1))     (Johnson & Cook 1983)
struct JohnsonCookRate {
  double reference_rate = 1, coefficient = 0;  // ε̇₀ 1/s, C
  Curve operator()(double rate) const {
    // Not std::max, which would hide a rate that is NaN.
    if (rate <= reference_rate) return {1, 0};
    return {1 + coefficient * std::log(rate / reference_rate), coefficient / rate};
  }
  double rate_at(double factor) const { return reference_rate * std::exp((factor - 1) / coefficient); }
};

using Rate = std::variant<NoRate, PowerRate, JohnsonCookRate>;

struct FlowStress {
  double yield_stress = 0;  // σ_y, Pa; a table brings its own
  Hardening hardening;
  Rate rate;

  struct Value {
    double stress, by_strain, by_rate;  // σ̄ Pa, ∂σ̄/∂ε̄ Pa, ∂σ̄/∂ε̇ Pa s
  };
  Value operator()(double strain, double strain_rate) const { return at_rate(strain_rate, at_rest(strain)); }

  // σ̄(ε̄, 0) and its slope; a curve that softens ends at zero.
  Curve at_rest(double strain) const {
    const Curve h = std::visit([this, strain](const auto& law) { return law(yield_stress, strain); }, hardening);
    return h.value < 0 ? Curve{0, 0} : h;
  }

  // σ̄(ε̄, ε̇) where the curve at rest has been evaluated.
  Value at_rate(double strain_rate, const Curve& h) const {
    const Curve r = std::visit([strain_rate](const auto& law) { return law(strain_rate); }, rate);
    return {h.value * r.value, h.slope * r.value, h.value * r.slope};
  }

  // No flow stress of this law is less than this: a test that costs no logarithm.
  double lower_bound() const {
    return std::visit([this](const auto& law) { return law.softens() ? 0 : yield_stress; }, hardening);
  }

  // The plastic strain rate at which the flow stress is `stress`, if `stress_at_rest` is the one at rest.
  double rate_at(double stress, double stress_at_rest) const {
    return std::visit([=](const auto& law) { return law.rate_at(stress / stress_at_rest); }, rate);
  }
};

}  // namespace strut::materials
