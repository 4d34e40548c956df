// Bonds that may break in equilibria, too: those of elastic solids, by a stretch that stays the same.
#pragma once

#include <variant>

#include "materials/laws.hpp"
#include "mechanics/damage_model.hpp"
#include "mechanics/formulation/formulation.hpp"

namespace strut {

// By quadratic correspondence a crack by stretch does not take its fracture energy; a crack that softens, or a metal
// that tears, would need load steps that follow it down (docs/decisions.md, Equilibria).
inline bool breaks_at_rest(Formulation formulation, const materials::AnyLaw& law, const DamageModel& damage) {
  return formulation != Formulation::quadratic && std::holds_alternative<materials::Elastic>(law) &&
         damage.critical_stretch && !damage.critical_stretch->depends_on_time();
}

}  // namespace strut
