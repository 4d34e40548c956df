// The larger of two numbers, for tests.
#pragma once

#include <algorithm>
#include <cmath>

namespace strut {

// NaN if one is: std::max drops it, and a limit then holds for a body that blew up.
inline double larger(double a, double b) { return std::isnan(a) || std::isnan(b) ? NAN : std::max(a, b); }

}  // namespace strut
