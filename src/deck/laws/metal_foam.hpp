// The keys of Deshpande and Fleck's metal foam, and how the law is made from them.
#pragma once

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

Section metal_foam_section();
materials::AnyLaw make_metal_foam(const Values& material, Problems& problems);

}  // namespace strut::deck
