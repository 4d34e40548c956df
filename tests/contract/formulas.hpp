// The formulas of the flow stress as the literature prints them: an oracle that shares no line with the laws.
#pragma once

#include <algorithm>
#include <cmath>

#include "materials/flow_stress.hpp"

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
};

inline double printed_flow_stress(const materials::FlowStress& flow, double strain, double rate) {
  return std::visit(PrintedHardening{flow.yield_stress, strain}, flow.hardening) *
         std::visit(PrintedRate{rate}, flow.rate);
}

}  // namespace strut::testing
