// The section Boundary Conditions: loads, motions and initial conditions of points.
#pragma once

#include <string>
#include <vector>

#include "conditions/prototype.hpp"
#include "deck/forward.hpp"

namespace strut::deck {

// One of the section Boundary Conditions.
struct Condition {
  std::string name;
  std::string node_set;     // of the mesh or the deck, a block's name, or "all"
  ConditionPrototype kind;  // without points yet
};

Section conditions_section();
std::vector<Condition> read_conditions(const Values& deck, Problems& problems);

}  // namespace strut::deck
