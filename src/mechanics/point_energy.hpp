// The energy that one point holds.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

struct PointEnergy {
  double elastic = 0, dissipated = 0, heat = 0;  // J/m³ of reference volume; heat: ρ c_p (T − T₀)
};

// What the law of block.points[k] has stored and dissipated; not of ordinary points.
PointEnergy law_energy(const Body& body, const MaterialBlock& block, std::size_t k);

// What an ordinary point stores, J/m³. `square`: Σ ω V e² over its family, m⁵.
double ordinary_energy(const MaterialBlock& block, const OrdinaryPoint& point, double square);

}  // namespace strut
