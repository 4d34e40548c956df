// The keys of elastomers.
#pragma once

#include "deck/laws/laws.hpp"

namespace strut::deck {

Section hyperelastic_section();
materials::AnyLaw make_hyperelastic(const Values& material, Problems& problems);

}  // namespace strut::deck
