// A deck's XML against the schema.
#pragma once

#include <string>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "deck/xml.hpp"

namespace strut::deck {

// `list` as `section` declares it, with all its sections; `section` must outlive the values. What one key alone can
// tell is checked here; what takes two (final after initial time, the material a block names) is checked where the
// structs are built.
Values check(const List& list, const Section& section, const std::string& path, Problems& problems);

}  // namespace strut::deck
