// The section Damage Models: criteria by which bonds break.
#pragma once

#include <string>
#include <vector>

#include "deck/forward.hpp"
#include "mechanics/damage_model.hpp"

namespace strut::deck {

struct NamedDamageModel {
  std::string name;
  DamageModel model;
};

Section damage_models_section();
std::vector<NamedDamageModel> read_damage_models(const Values& deck, Problems& problems);

}  // namespace strut::deck
