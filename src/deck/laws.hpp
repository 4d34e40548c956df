// The material laws as a deck names them: for each its keys and how it is made from them. A new law is one entry.
#pragma once

#include <vector>

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

struct LawEntry {
  Section schema;  // named as "Material Model" has it
  Formulation formulation;
  materials::AnyLaw (*make)(const Values& material, Problems& problems);
};

const std::vector<LawEntry>& laws();

// What all materials share: density, elastic constants.
Section material_section();

// From Young's modulus (Pa) and Poisson's ratio.
materials::Moduli moduli_from(double E, double nu);

// Of a metal foam; `foam`: its moduli as it is at first.
Section metal_foam_section();
materials::AnyLaw make_metal_foam(const Values& material, const materials::Moduli& foam, Problems& problems);

// Of a polymeric foam; `solid`: the moduli of its polymer.
Section polymer_foam_section();
materials::AnyLaw make_polymer_foam(const Values& material, const materials::Moduli& solid, Problems& problems);

// Whether the keys Strains and Stresses of a section make a table, with strains that rise from 0; says so where not.
bool check_table(const Values& hardening, Problems& problems);

// The keys "Yield Stress", Hardening and Rate of a law with a flow stress.
Section flow_stress_section();
materials::FlowStress make_flow_stress(const Values& material, Problems& problems);

}  // namespace strut::deck
