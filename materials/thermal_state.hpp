// The state of metals with temperature, and code that their flow stresses share. Units: Pa, 1/s, K, strain -.
#pragma once

#include <limits>

#include "materials/radial_return.hpp"
#include "materials/side_by_side.hpp"

namespace strut::materials {

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

}  // namespace strut::materials
