#include "mechanics/hindered_breaks.hpp"

#include <algorithm>

#include "mechanics/body.hpp"

namespace strut {

bool breaks_at_rest(const MaterialBlock& block) {
  const auto& damage = block.material.damage;
  return damage && breaks_at_rest(block.material.formulation, block.material.law, *damage);
}

std::string hindrance_of_breaks(const Body& body) {
  for (const MaterialBlock& block : body.blocks) {
    const bool stays =
        !block.material.damage && stays_while_others_break(block.material.formulation, block.material.law);
    if (!stays && !breaks_at_rest(block)) return "block '" + block.name + "' (its material or Damage Model)";
  }
  const auto rests = [](const Period& period) { return period.stretch.is_constant(); };
  if (!body.heated.empty()) return "Prescribed Temperature";
  if (!body.domain.mirrors.empty()) return "Symmetry Plane";
  return std::ranges::all_of(body.domain.periods, rests) ? "" : "Periodic Sides that move";
}

}  // namespace strut
