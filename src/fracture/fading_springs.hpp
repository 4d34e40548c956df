// Springs on both ends' gradients beside a gradual crack. Their stiffness falls with the stress of their softer end:
// whole springs would hold over the points that soften, and the crack would take up to twice its fracture energy.
#pragma once

#include <vector>

#include "fracture/work_balance.hpp"
#include "mechanics/body.hpp"

namespace strut {

// True if the block has such springs.
inline bool springs_fade(const MaterialBlock& block) {
  return block.material.damage && block.material.damage->is_gradual && block.has_springs(ResidualKind::both_gradients);
}

// Counts as fracture energy what springs have lost since the step's start, whose gradient states are given: for a
// bond ½ (C − C') z·z', with its residuals z and z' at both ends of the step; where the bonds of an end broke, its bond
// work balance has that.
void count_fading(Body& body, const StepEnd& end, const std::vector<GradientState>& start);

}  // namespace strut
