// The keys of elastomers.
#pragma once

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

Section hyperelastic_section();
materials::AnyLaw make_hyperelastic(const Values& material, Problems& problems);

}  // namespace strut::deck
