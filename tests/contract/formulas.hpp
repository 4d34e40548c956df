// The formulas of the flow stress as the literature prints them: an oracle that shares no line with the laws.
#pragma once

#include <algorithm>
#include <cmath>

#include "materials/deshpande_fleck.hpp"
#include "materials/flow_stress.hpp"
#include "materials/polymer_foam.hpp"
#include "materials/thermal_flow.hpp"

namespace strut::testing {

struct PrintedHardening {
  double yield, strain;
  double operator()(const materials::NoHardening&) const { return yield; }
  double operator()(const materials::LinearHardening& h) const { return std::max(0.0, yield + h.modulus * strain); }
  double operator()(const materials::PowerHardening& h) const {
    return yield * std::pow(1 + strain / h.reference_strain, h.exponent);
  }
  double operator()(const materials::LudwikHardening& h) const {
    return yield + h.modulus * std::pow(strain, h.exponent);
  }
  double operator()(const materials::VoceHardening& h) const {
    return yield + h.saturation * (1 - std::exp(-h.rate * strain));
  }
  double operator()(const materials::NeedlemanHardening& h) const {
    return yield * std::pow(1 + strain / h.reference_strain, h.exponent) /
           (1 + std::pow(strain / h.softening_strain, 2));
  }
  double operator()(const materials::TableHardening& h) const {
    for (std::size_t i = 1; i < h.strains.size(); ++i) {
      const double place = (strain - h.strains[i - 1]) / (h.strains[i] - h.strains[i - 1]);
      if (place <= 1) return (1 - place) * h.stresses[i - 1] + place * h.stresses[i];
    }
    return h.stresses.back();
  }
};

struct PrintedRate {
  double rate;
  double operator()(const materials::NoRate&) const { return 1; }
  double operator()(const materials::PowerRate& r) const { return std::pow(1 + rate / r.reference_rate, r.exponent); }
  double operator()(const materials::JohnsonCookRate& r) const {
    return 1 + r.coefficient * std::log(std::max(rate / r.reference_rate, 1.0));
  }
  double operator()(const materials::NeedlemanRate& r) const {
    return std::pow(std::max(rate / r.reference_rate, 1.0), r.exponent);
  }
};

inline double printed_flow_stress(const materials::FlowStress& flow, double strain, double rate) {
  return std::visit(PrintedHardening{flow.yield_stress, strain}, flow.hardening) *
         std::visit(PrintedRate{rate}, flow.rate);
}

// ---- Metals with temperature ----------------------------------------------------------------------------------------

// Rates below 1e-3 /s count as 1e-3 /s.
inline double printed_flow_stress(const materials::ZerilliArmstrong& f, double strain, double rate, double T, double) {
  const double thermal = f.thermal.modulus * std::pow(strain, f.thermal.exponent);
  return f.athermal + f.hardening.modulus * std::pow(strain, f.hardening.exponent) +
         thermal * std::exp(-f.softening * T + f.rate_softening * T * std::log(std::max(rate, 1e-3)));
}

inline double printed_flow_stress(const materials::MechanicalThreshold& f, double, double rate, double T,
                                  double threshold) {
  const double mu = f.shear - f.shear_fall / (std::exp(f.shear_temperature / T) - 1);
  const double barrier = f.boltzmann * T / (f.energy * mu) * std::log(f.rate / std::max(rate, 1e-3));
  const double S = std::pow(1 - std::pow(std::clamp(barrier, 0.0, 1.0), 1 / f.q), 1 / f.p);
  return f.athermal + S * threshold * mu / f.shear;
}

inline double printed_flow_stress(const materials::SoftenedFlow& f, double strain, double rate, double T, double) {
  const auto& s = std::get<materials::JohnsonCookSoftening>(f.softening);
  const double relative = std::clamp((T - s.reference) / (s.melting - s.reference), 0.0, 1.0);
  return printed_flow_stress(f.cold, strain, rate) * (1 - std::pow(relative, s.exponent));
}

// ---- The stress that is compared with the flow stress: von Mises', or by the yield surface of a foam ----------------

template <class L>
double printed_equivalent_stress(const L&, const Symmetric& stress, const typename L::State&) {
  return von_mises(stress);
}

// Deshpande & Fleck (2000).
inline double printed_equivalent_stress(const materials::DeshpandeFleck& law, const Symmetric& stress,
                                        const materials::DeshpandeFleck::State&) {
  return std::hypot(von_mises(stress), law.alpha * trace(stress) / 3) / std::hypot(1, law.alpha / 3);
}

// An ellipse in Kirchhoff stress, (q/(αA))² + ((p − p₀)/A)² = 1, from −p_t to p_c: the uniaxial compression τ_y/J times
// the factor by which it must grow from zero stress to go through the stress.
inline double printed_equivalent_stress(const materials::PolymerFoam& law, const Symmetric& stress,
                                        const materials::PolymerFoam::State& state) {
  const double J = state.relative_density > 0 ? law.initial_density / state.relative_density : 1;
  const auto [uniaxial, compression] = law.yield_stresses(state.compaction);
  const double tension = law.tension_ratio * compression, third = uniaxial / 3;
  const double center = (compression - tension) / 2, axis = (compression + tension) / 2;
  const double alpha = uniaxial / std::sqrt((compression - third) * (tension + third));
  const double q = J * von_mises(stress) / (alpha * axis), p = -J * trace(stress) / 3 / axis, p0 = center / axis;
  const double square = q * q + p * p;
  return square > 0 ? uniaxial / J * square / (p * p0 + std::sqrt(p * p * p0 * p0 + square * (1 - p0 * p0))) : 0;
}

}  // namespace strut::testing
