// One of the section Boundary Conditions.
#pragma once

#include <string>

#include "conditions/prototype.hpp"

namespace strut::deck {

struct Condition {
  std::string name;
  std::string node_set;     // of the mesh or the deck, a block's name, or "all"
  ConditionPrototype kind;  // without points yet
};

}  // namespace strut::deck
