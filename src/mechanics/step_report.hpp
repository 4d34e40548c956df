// The results of a step for the points of this rank.
#pragma once

#include <algorithm>

#include "mechanics/failure.hpp"

namespace strut {

struct StepReport {
  double frequency_bound =
      0;  // 1/s, the largest of any point times its fraction of the step: the critical time step shrinks as it grows
  // ζ, the largest fraction of critical damping by viscosity: it multiplies the critical time step by √(1 + ζ²) − ζ.
  double damping = 0;
  std::optional<Failure> failure;  // the worst on this rank; its stress keeps the old value

  void add(const StepReport& other) {
    frequency_bound = std::max(frequency_bound, other.frequency_bound);
    damping = std::max(damping, other.damping);
    take_worse(other.failure, failure);
  }
};

}  // namespace strut
