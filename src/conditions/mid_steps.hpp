// Velocities of central differences are those at mid-steps; this interpolates them to the time between two steps.
#pragma once

#include <algorithm>

#include "base/math/tensors.hpp"

namespace strut {

struct MidSteps {
  // Length of the step before the time over the sum of both steps: ½ for equal ones, 0 if there was no step before.
  double before = 0.5;

  // The velocity at the time, from those in the middle of the steps before and after it.
  Vector velocity(const Vector& v_before, const Vector& v_after) const {
    return (1 - before) * v_before + before * v_after;
  }

  // v² at the time, minus (½ Δt a)² with the longer of both steps: with ½ m times this, the energy of a linear body is
  // conserved to round-off over steps of this length. For equal steps it is v⁻·v⁺; at the start of a run, v².
  double conserved_square(const Vector& v, const Vector& v_after) const {
    if (before == 0) return v.squaredNorm();
    const Vector half_step = std::max(before, 1 - before) / (1 - before) * (v_after - v);
    return (v - half_step).dot(v + half_step);
  }
};

}  // namespace strut
