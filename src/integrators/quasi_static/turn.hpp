// The work of holding forces in a load step in which the points that they hold turn.
#pragma once

#include <vector>

#include "base/math/tensors.hpp"
#include "base/parallel/communicator.hpp"

namespace strut {

struct HeldPoint {
  Vector before, after;              // its positions at both ends of the step, m
  Vector force_before, force_after;  // on it, N
};

// Collective. What the forces on these points of all ranks do beyond ½ (f₀ + f₁)·Δu, J on this rank, if the points move
// nearly as a rigid body: on arcs, with forces that turn with them. Along chords, the changes Δf of the reactions of a
// clamped end do a work of some ¼ θ² Δf l in a turn by θ, which may be more than a little strained body stores. Zero
// for other motions.
double work_beyond_chords(const std::vector<HeldPoint>& points, const Communicator& ranks);

}  // namespace strut
