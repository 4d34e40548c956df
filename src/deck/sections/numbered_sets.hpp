// Node sets by number, as in Peridigm's decks: parameters among the boundary conditions.
#pragma once

#include <filesystem>
#include <vector>

#include "deck/schema.hpp"
#include "deck/sections/node_sets.hpp"

namespace strut::deck {

// The section with these sets.
inline const char* const boundary_conditions = "Boundary Conditions";

Key numbered_set();

// Numbers in files are read later by read_numbers, because that accesses the disk.
void add_numbered_sets(const Values& deck, const std::filesystem::path& deck_file, std::vector<NodeSet>& sets,
                       Problems& problems);
void read_numbers(std::vector<NodeSet>& sets, Problems& problems);

}  // namespace strut::deck
