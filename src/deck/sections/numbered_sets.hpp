// Sets of points by number, as Peridigm writes them: parameters among the boundary conditions.
#pragma once

#include <filesystem>
#include <vector>

#include "deck/schema.hpp"
#include "deck/sections/node_sets.hpp"

namespace strut::deck {

// The section that has them.
inline const char* const boundary_conditions = "Boundary Conditions";

Key numbered_set();

// Those in files are left to read_numbers, which takes the disk.
void add_numbered_sets(const Values& deck, const std::filesystem::path& deck_file, std::vector<NodeSet>& sets,
                       Problems& problems);
void read_numbers(std::vector<NodeSet>& sets, Problems& problems);

}  // namespace strut::deck
