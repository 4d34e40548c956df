// The energies that a body stores and has dissipated.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

struct Energies {
  double elastic = 0, dissipated = 0, stabilization = 0, fracture = 0;  // J
  double heat = 0;  // J, ρ c_p (T − T₀); for information, not a term of the energy balance
};

// Collective: sums over all ranks. Call it after a stress update with diagnostics.
Energies stored_energies(const Body& body);

}  // namespace strut
