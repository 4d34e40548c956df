// Values of a deck's expressions, which must be numbers.
#pragma once

#include "base/math/function.hpp"
#include "base/math/tensors.hpp"

namespace strut {

// The value at X (m) and t (s); throws Error where the arithmetic has no result (the root of a negative number, a
// division by zero).
double finite_value(const Function& function, const Vector& X, double t);

}  // namespace strut
