// Velocities of central differences live at mid-steps: what they make at the time between two steps of any lengths.
#pragma once

#include <algorithm>

#include "base/math/tensors.hpp"

namespace strut {

struct MidSteps {
  // The length of the step before the time as a part of that of both: ½ of equal ones, 0 where no step came before.
  double before = 0.5;

  // At the time, from the velocities in the middle of the step before and of the one after.
  Vector velocity(const Vector& v_before, const Vector& v_after) const {
    return (1 - before) * v_before + before * v_after;
  }

  // v² at the time, less (½ Δt a)² with the longer of both steps: with ½ m of this the energy of a linear body stays as
  // it is to round-off over steps of this length. Of equal steps it is v⁻·v⁺; where a run begins, v².
  double conserved_square(const Vector& v, const Vector& v_after) const {
    if (before == 0) return v.squaredNorm();
    const Vector half_step = std::max(before, 1 - before) / (1 - before) * (v_after - v);
    return (v - half_step).dot(v + half_step);
  }
};

}  // namespace strut
