// The section Boundary Conditions: what is imposed on points, initial conditions included.
#pragma once

#include <vector>

#include "deck/forward.hpp"
#include "deck/sections/condition.hpp"

namespace strut::deck {

Section conditions_section();
std::vector<Condition> read_conditions(const Values& deck, Problems& problems);

}  // namespace strut::deck
