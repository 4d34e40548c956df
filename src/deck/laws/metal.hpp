// The law of a metal: J2 plasticity, with heat and an equation of state if the deck asks for them.
#pragma once

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

Section metal_section();
materials::AnyLaw make_metal(const Values& material, Problems& problems);

}  // namespace strut::deck
