// A point at which a step failed, and the message about it.
#pragma once

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

// "element 17 of block foam, reference position (…) m, now at (…) m"
std::string locate(const Body& body, int i);

// locate(), followed by the failure and its likely cause.
std::string describe(const Failure& failure, const Body& body);

}  // namespace strut
