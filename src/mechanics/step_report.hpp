// The results of a step for the points of this rank.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "mechanics/body.hpp"

namespace strut {

// A point at which a step failed.
struct Failure {
  int point;                                                 // owned, local index
  enum class Kind { not_finite, no_stress, inverted } kind;  // the worst first
};

// Leaves the worse failure in `worst`; between equal kinds the lower point index wins, whatever the order of the calls.
inline void take_worse(const std::optional<Failure>& other, std::optional<Failure>& worst) {
  const auto order = [](const Failure& f) { return std::pair(f.kind, f.point); };
  if (other && (!worst || order(*other) < order(*worst))) worst = other;
}

std::string place_text(const Vector& place);  // "(x, y, z) m"

// "element 17 of block foam, reference position (…) m, now at (…) m"; "" for −1, a point of another rank
std::string locate(const Body& body, int i);

// locate(), followed by the failure and its likely cause.
std::string describe(const Failure& failure, const Body& body);

struct StepReport {
  // 1/s, the largest of any point times its fraction of the step: the critical time step shrinks as it grows.
  double frequency_bound = 0;
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
