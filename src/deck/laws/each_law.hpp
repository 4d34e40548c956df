// The keys of each material law, and how the law is made from them; each pair in a source of its name (metal.cpp).
#pragma once

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

// J2 plasticity, with heat and an equation of state if the deck asks for them.
Section metal_section();
materials::AnyLaw make_metal(const Values& material, Problems& problems);

// Deshpande and Fleck's metal foam.
Section metal_foam_section();
materials::AnyLaw make_metal_foam(const Values& material, Problems& problems);

// The crushable polymeric foam.
Section polymer_foam_section();
materials::AnyLaw make_polymer_foam(const Values& material, Problems& problems);

// Elastomers.
Section hyperelastic_section();
materials::AnyLaw make_hyperelastic(const Values& material, Problems& problems);

// Laws from shared objects. Their libraries are loaded later (load_user_libraries).
Section user_library_section();
materials::AnyLaw make_user_library(const Values& material, Problems& problems);

}  // namespace strut::deck
