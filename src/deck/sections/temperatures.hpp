// Checks of thermal expansion that need several sections.
#pragma once

#include <vector>

#include "deck/forward.hpp"
#include "deck/sections/conditions.hpp"
#include "deck/sections/materials.hpp"

namespace strut::deck {

// `has_expanded`: bodies may have thermal strains at the start.
void check_temperatures(const std::vector<Material>& materials, const std::vector<Condition>& conditions,
                        bool has_expanded, Problems& problems);

}  // namespace strut::deck
