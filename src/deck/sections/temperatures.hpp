// Checks of thermal expansion that need several sections.
#pragma once

#include <vector>

#include "deck/forward.hpp"
#include "deck/sections/conditions.hpp"
#include "deck/sections/materials.hpp"

namespace strut::deck {

void check_temperatures(const std::vector<Material>& materials, const std::vector<Condition>& conditions,
                        Problems& problems);

}  // namespace strut::deck
