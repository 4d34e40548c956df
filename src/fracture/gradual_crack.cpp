#include <algorithm>
#include <cmath>
#include <vector>

#include "fracture/separation.hpp"

namespace strut {

GradualCrack gradual_crack(const PulledLattice& lattice, double fracture_energy) {
  constexpr double zone = 4;                    // E G_c/σ_c², spacings: fewer do not resolve the zone that softens
  double trace = 0, stretches = 0, across = 0;  // stretches: sum of their squares at an opening of 1 m
  std::vector<double> parts;                    // of the opening in the gradient of the layers, times K
  for (const LatticeBond& bond : family_of(lattice)) {
    trace += bond.weight * bond.xi.squaredNorm();
    if (bond.layers_below <= 0) continue;
    parts.resize(std::max<std::size_t>(parts.size(), bond.layers_below), 0);
    for (int layer = 0; layer < bond.layers_below; ++layer) parts[layer] += bond.weight * std::abs(bond.xi[2]);
    stretches += bond.layers_below / (bond.opening * bond.opening), across += bond.layers_below;
  }
  double squares = 0;  // Σ g², 1/m²; both halves are alike
  for (const double part : parts) squares += 2 * std::pow(part / (trace / 3), 2);
  const auto [bulk, shear] = lattice.moduli;
  const double young = 9 * bulk * shear / (3 * bulk + shear);
  const double strength = std::sqrt(young * fracture_energy / (zone * lattice.spacing));
  const double last = 2 * fracture_energy / strength;
  return {strength, 1 / (lattice.spacing * squares), last * std::sqrt(stretches / across)};
}

}  // namespace strut
