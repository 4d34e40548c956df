// The material laws of a deck: the keys of each, and how it is made from them. A new law is one entry.
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

}  // namespace strut::deck
