// The material laws of a deck: the keys of each, and how it is made from them, in a source of its name (metal.cpp). A
// new law is one entry.
#pragma once

#include <vector>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

struct LawEntry {
  Section schema;  // named by the values of "Material Model"
  materials::AnyLaw (*make)(const Values& material, Problems& problems);
  bool by_correspondence = true;  // it then also has the keys of all such laws
  bool expands = false;           // it has a Thermal Expansion Coefficient
};

const std::vector<LawEntry>& laws();

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
