// The columns of a law's state by their names.
#pragma once

#include <algorithm>
#include <string_view>
#include <variant>

#include "mechanics/material_block.hpp"

namespace strut {

// -1 if the law of the block has no such state variable.
inline int state_column(const MaterialBlock& block, std::string_view name) {
  const auto column = [&]<class L>(const L&) {
    const auto& names = L::state_names;
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? -1 : static_cast<int>(at - names.begin());
  };
  return std::visit(column, block.material.law);
}

}  // namespace strut
