// Inside mechanics: ordinary solids, from the places of the points of a block to the force state of each.
#pragma once

#include "mechanics/formulation/stress_pass.hpp"

namespace strut {

void advance_ordinary(Body& body, MaterialBlock& block, bool with_diagnostics, const LaneGroups& groups,
                      StepReport& report);

// The state of the bonds of an ordinary point of dilatation θ and weighted volume m.
inline ScalarState scalar_state(const materials::Moduli& moduli, double dilatation, double weighted_volume) {
  return {(3 * moduli.bulk - 5 * moduli.shear) * dilatation / weighted_volume, 15 * moduli.shear / weighted_volume};
}

}  // namespace strut
