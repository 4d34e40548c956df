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

// Collective. Correction of the work ½ (f₀ + f₁)·Δu of the forces on these points (of all ranks), J on this rank, for
// points that turn nearly as a rigid body: they move on arcs, and the forces turn with them. Without it, the work of
// the reactions of a clamped end that turns by θ is wrong by some ¼ θ² Δf l (Δf: their change, l: a length of the end),
// which may be more than a slightly strained body stores. Zero for other motions.
double work_beyond_chords(const std::vector<HeldPoint>& points, const Communicator& ranks);

}  // namespace strut
