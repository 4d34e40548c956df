// The constants of every material: its density and two of the four elastic ones.
#pragma once

#include <vector>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

std::vector<Key> constants_keys();

double read_density(const Values& material);  // kg/m³

// The moduli from any two of the elastic constants; reports if there are not two, or if they contradict each other.
materials::Moduli checked_moduli(const Values& material, Problems& problems);

// The moduli from Young's modulus (Pa) and Poisson's ratio.
materials::Moduli moduli_from(double E, double nu);

}  // namespace strut::deck
