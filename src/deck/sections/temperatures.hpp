// Checks of thermal expansion that need several sections.
#pragma once

#include <vector>

#include "deck/forward.hpp"
#include "deck/sections/blocks.hpp"
#include "deck/sections/conditions.hpp"
#include "deck/sections/damage_models.hpp"
#include "deck/sections/materials.hpp"

namespace strut::deck {

// The sections that thermal expansion concerns.
struct HeatedSections {
  const std::vector<Material>& materials;
  const std::vector<NamedDamageModel>& damage_models;
  const std::vector<Block>& blocks;
  const std::vector<Condition>& conditions;
};

void check_temperatures(const HeatedSections& deck, Problems& problems);

}  // namespace strut::deck
