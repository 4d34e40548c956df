// Values of a deck's expressions, which must be finite.
#pragma once

#include "base/math/function.hpp"
#include "base/math/tensors.hpp"

namespace strut {

// The value at X (m) and t (s). Throws Error if it is not finite (the root of a negative number, a division by
// zero).
double finite_value(const Function& function, const Vector& X, double t);

}  // namespace strut
