// A point at which a step went wrong, and what is said of it.
#pragma once

#include <optional>
#include <string>

#include "mechanics/body.hpp"

namespace strut {

// A point at which a step went wrong.
struct Failure {
  int point;                                                 // owned, local index
  enum class Kind { not_finite, no_stress, inverted } kind;  // the worst first
};

// Leaves the worse of both in `worst`.
inline void take_worse(const std::optional<Failure>& other, std::optional<Failure>& worst) {
  if (other && (!worst || other->kind < worst->kind)) worst = other;
}

// "element 17 of block foam, reference position (…) m, now at (…) m"
std::string locate(const Body& body, int i);

// The same, and what the failure is and its likely cause.
std::string describe(const Failure& failure, const Body& body);

}  // namespace strut
