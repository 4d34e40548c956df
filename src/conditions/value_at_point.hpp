// The value of a function of the deck at a point of the body.
#pragma once

#include "base/math/function.hpp"
#include "mechanics/body.hpp"

namespace strut {

// The value at its reference position and time t (s).
inline double value_at_point(const Function& value, const Body& body, int i, double t) {
  const Vector X = body.domain.reference(i);
  return value(X[0], X[1], X[2], t);
}

}  // namespace strut
