// Integrals over time of the values of a deck.
#pragma once

#include <string>
#include <vector>

#include "base/math/function.hpp"

namespace strut {

// The numbers of a text, in order, those of tables, too: among them are the times at which a function of time may turn
// or jump.
std::vector<double> numbers_in(const std::string& text);

// The integral from one time to another, by Gauss's rule in equal parts, divided further at `turns`: exact for tables
// and steps in t. `value` stores a result that is not finite.
double time_integral(const Function& value, const Vector& X, double from, double to, const std::vector<double>& turns);

}  // namespace strut
