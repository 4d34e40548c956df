// A curve as a table: the keys Strains and Stresses of a section.
#pragma once

#include <string>
#include <vector>

#include "deck/problems.hpp"
#include "deck/values.hpp"
#include "materials/flow_stress.hpp"

namespace strut::deck {

// The keys with their meanings, and the range of the stresses.
std::vector<Key> table_keys(const std::string& strains, const std::string& stresses, Range range = {});

// True if they make a table, with strains that increase from 0; else reports it.
bool check_table(const Values& values, Problems& problems);

materials::TableHardening read_table(const Values& values);
std::string path_to_stresses(const Values& values);

}  // namespace strut::deck
