// Public header of materials: every law, and the variant that a block holds.
#pragma once

#include <variant>

#include "materials/deshpande_fleck.hpp"
#include "materials/ductile.hpp"
#include "materials/elastic.hpp"
#include "materials/j2.hpp"
#include "materials/law.hpp"
#include "materials/polymer_foam.hpp"

namespace strut::materials {

using AnyLaw = std::variant<Elastic, J2, Ductile, DeshpandeFleck, PolymerFoam>;

}  // namespace strut::materials
