// What a step tells of the points of this rank.
#pragma once

#include <algorithm>

#include "mechanics/failure.hpp"

namespace strut {

struct StepReport {
  double frequency_bound =
      0;  // 1/s, the largest of any point, as a part of its step: the critical time step shrinks with it
  // ζ, the largest part of the critical damping by viscosity: the critical time step is √(1 + ζ²) − ζ of that without.
  double damping = 0;
  std::optional<Failure> failure;  // the worst on this rank; its stress is the old one

  void add(const StepReport& other) {
    frequency_bound = std::max(frequency_bound, other.frequency_bound);
    damping = std::max(damping, other.damping);
    take_worse(other.failure, failure);
  }
};

}  // namespace strut
