// The section Node Sets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/math/function.hpp"
#include "base/math/tensors.hpp"
#include "deck/forward.hpp"
#include "deck/schema.hpp"

namespace strut::deck {

// A node set of the deck: the points whose reference position makes `where` nonzero, or those with these numbers, or
// the one that is nearest to a place.
struct NodeSet {
  std::string name;
  Function where;
  std::optional<std::vector<std::int64_t>> numbers = {};  // of elements or points, from 1, ascending, each once
  std::optional<Vector> nearest = {};                     // m
  std::filesystem::path file = {};                        // file that they were read from, if any
};

Section node_sets_section();
std::vector<NodeSet> read_node_sets(const Values& deck, Problems& problems);

// The section with sets by number, as in Peridigm's decks: parameters among the boundary conditions.
inline const char* const boundary_conditions = "Boundary Conditions";

Key numbered_set();

// Numbers in files are read later by read_numbers, because that accesses the disk.
void add_numbered_sets(const Values& deck, const std::filesystem::path& deck_file, std::vector<NodeSet>& sets,
                       Problems& problems);
void read_numbers(std::vector<NodeSet>& sets, Problems& problems);

}  // namespace strut::deck
