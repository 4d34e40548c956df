// The section Boundary Conditions: loads, motions and initial conditions of points.
#pragma once

#include <vector>

#include "deck/forward.hpp"
#include "deck/sections/condition.hpp"

namespace strut::deck {

Section conditions_section();
std::vector<Condition> read_conditions(const Values& deck, Problems& problems);

}  // namespace strut::deck
