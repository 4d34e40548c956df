// The keys of laws from shared objects. Their libraries are loaded later (deck/sections/loaded_libraries.hpp).
#pragma once

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

Section user_library_section();
materials::AnyLaw make_user_library(const Values& material, Problems& problems);

}  // namespace strut::deck
