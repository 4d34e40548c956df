// The material laws as a deck names them: for each its keys and how it is made from them. A new law is one entry.
#pragma once

#include <vector>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

struct LawEntry {
  Section schema;  // named as "Material Model" has it
  materials::AnyLaw (*make)(const Values& material, Problems& problems);
  bool by_correspondence = true;  // and has the keys of all such laws, too
};

const std::vector<LawEntry>& laws();

}  // namespace strut::deck
