// The energies that a body stores and has dissipated.
#pragma once

#include <vector>

#include "mechanics/body.hpp"

namespace strut {

class Committed;

// The energy that one point stores and has dissipated.
struct PointEnergy {
  double elastic = 0, dissipated = 0, heat = 0;  // J/m³ of reference volume; heat: ρ c_p (T − T₀)
  double cracks = 0;                             // the part of the dissipation that counts as energy of fracture
};

// Energy that the law of block.points[k] has stored and dissipated; not for ordinary points.
PointEnergy law_energy(const Body& body, const MaterialBlock& block, std::size_t k);

// Energy that an ordinary point stores, J/m³. `square`: Σ ω V e² over its family, m⁵.
double ordinary_energy(const MaterialBlock& block, const OrdinaryPoint& point, double square);

struct Energies {
  double elastic = 0, dissipated = 0, stabilization = 0, fracture = 0;  // J
  double expansion = 0;  // J, done on the body by thermal expansion (expansion.hpp)
  double heat = 0;       // J, ρ c_p (T − T₀); for information, not a term of the energy balance
};

// Work of thermal expansion on this rank's points so far, also in a run that this one starts from, J.
double work_of_expansion(const Body& body);

// Collective: sums over all ranks. Call it after a stress update with diagnostics.
Energies stored_energies(const Body& body);

// Collective, likewise: a sum for each body of the domain, without the energies of expansion and of broken bonds.
std::vector<Energies> stored_energies_of_bodies(const Body& body);

// The plastic work since `start` that laws have not counted, J on this rank: the work of the flow stress along the
// plastic strain less the counted work. Laws take the mean stress of both ends of a step: too little where it begins
// far below yield, next to nothing where it leads from tension at yield to compression at yield.
double missed_plastic_work(const Body& body, const Committed& start);

}  // namespace strut
