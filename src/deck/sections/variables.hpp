// Lists of output variables, whose keys are names of variables.
#pragma once

#include <string>
#include <vector>

#include "deck/values.hpp"

namespace strut::deck {

inline std::vector<std::string> switched_on(const Values& variables, const AnyKey<bool>& variable) {
  std::vector<std::string> names;
  for (const auto& [name, on] : variables.all(variable)) {
    if (on) names.push_back(name);
  }
  return names;
}

}  // namespace strut::deck
