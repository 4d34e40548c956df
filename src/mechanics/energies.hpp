// The energies that a body holds and has dissipated.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

struct Energies {
  double elastic = 0, dissipated = 0, stabilization = 0, fracture = 0;  // J
};

// Collective: sums over all ranks, after a stress update with diagnostics.
Energies stored_energies(const Body& body);

}  // namespace strut
