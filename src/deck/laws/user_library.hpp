// Laws from shared objects: their keys, and how their libraries are loaded and tried.
#pragma once

#include <filesystem>
#include <vector>

#include "deck/laws/laws.hpp"
#include "deck/sections/materials.hpp"

namespace strut::deck {

Section user_library_section();
materials::AnyLaw make_user_library(const Values& material, Problems& problems);

// Loads the library of each material that has one, by its path from the folder of the deck, and tries it with steps of
// an undeformed point.
void load_user_libraries(std::vector<Material>& materials, const std::filesystem::path& folder, Problems& problems);

}  // namespace strut::deck
