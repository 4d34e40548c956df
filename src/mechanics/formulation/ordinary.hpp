// Inside mechanics: ordinary solids, from the positions of a block's points to their force states.
#pragma once

#include "mechanics/formulation/stress_pass.hpp"

namespace strut {

void advance_ordinary(Body& body, MaterialBlock& block, bool with_diagnostics, const LaneGroups& groups,
                      StepReport& report);

// The force state of an ordinary point with dilatation θ and weighted volume m (m⁵).
inline ScalarState scalar_state(const materials::Moduli& moduli, double dilatation, double weighted_volume) {
  return {(3 * moduli.bulk - 5 * moduli.shear) * dilatation / weighted_volume, 15 * moduli.shear / weighted_volume};
}

}  // namespace strut
