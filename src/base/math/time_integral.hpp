// The times that show what a value of a deck does, and its integral over time.
#pragma once

#include <vector>

#include "base/math/function.hpp"

namespace strut {

// So many parts from one time to another, whose lengths differ: samples at equal distances may all meet a wave at the
// same phase. Both ends are among the times.
std::vector<double> uneven_times(double from, double to, int parts);

// The times, in order, at which to look at a value so as to miss nothing of what it does from one time to another:
// uneven ones, its turns, the middles between these, and, unless there are many, times ever nearer to each.
std::vector<double> telling_times(const Function& value, const Vector& X, double from, double to, int parts);

// The integral from one time to another, by Gauss's rule in parts that are halved where halves give another result:
// exact for tables and steps in t. `value` stores a result that is not finite.
double time_integral(const Function& value, const Vector& X, double from, double to);

}  // namespace strut
