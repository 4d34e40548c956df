// Integrals over time of the values of a deck.
#pragma once

#include <string>
#include <vector>

#include "base/math/function.hpp"

namespace strut {

// The numbers of a text, in order, those of tables, too: among them are the times at which a function of time may turn
// or jump.
std::vector<double> numbers_in(const std::string& text);

// From one time to another, by a rule of Gauss in each of some equal parts, which end also at these times: exact for
// tables and steps in t. Stores values that are not finite.
double time_integral(const Function& value, const Vector& X, double from, double to, const std::vector<double>& turns);

}  // namespace strut
