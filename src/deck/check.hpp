// Checks a deck against the schema.
#pragma once

#include <string>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "deck/xml.hpp"

namespace strut::deck {

// The values of `list` as `section` declares it, with all of its sections; `section` must outlive the values. Only
// checks of single keys are made here; those of two keys (final after initial time, the material that a block names)
// are made where the structs are built.
Values check(const List& list, const Section& section, const std::string& path, Problems& problems);

// Reports names that a list has twice, with those of its sections.
void report_duplicates(const List& list, const std::string& path, Problems& problems);

}  // namespace strut::deck
