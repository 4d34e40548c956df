// Shared objects that materials name.
#pragma once

#include <filesystem>
#include <vector>

#include "deck/problems.hpp"
#include "deck/sections/materials.hpp"

namespace strut::deck {

// Loads the library of each material that has one, by its path from the folder of the deck, and tries it with steps of
// an undeformed point.
void load_user_libraries(std::vector<Material>& materials, const std::filesystem::path& folder, Problems& problems);

}  // namespace strut::deck
