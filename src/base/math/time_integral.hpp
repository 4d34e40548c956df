// The times that show what a value of a deck does, and its integral over time.
#pragma once

#include <vector>

#include "base/math/function.hpp"

namespace strut {

// The ends of `parts` parts of different lengths, s, in order, from the first time to the last: samples at equal
// distances may all meet a wave at the same phase.
std::vector<double> uneven_times(double from, double to, int parts);

// The times, in order, at which to look at a value so as to miss nothing of what it does from one time to another:
// uneven ones, its turns, the middles between these, and, unless there are many, times ever nearer to each.
std::vector<double> telling_times(const Function& value, const Vector& X, double from, double to, int parts);

// The integral over time (unit of the value times s), by Gauss's rule in parts, which are halved until the halves give
// the same to 1e-10: exact for tables and steps in t. `value` stores a result that is not finite.
double time_integral(const Function& value, const Vector& X, double from, double to);

}  // namespace strut
