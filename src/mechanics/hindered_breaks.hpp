// Bonds that may break in equilibria, too: those of elastic solids, by a stretch that stays the same or a cohesive
// crack.
#pragma once

#include <string>
#include <variant>

#include "materials/laws.hpp"
#include "mechanics/damage_model.hpp"
#include "mechanics/formulation/formulation.hpp"

namespace strut {

struct Body;
struct MaterialBlock;

// Each round of breaks passes the time of a load step once more in all blocks, those that hold included: a law with a
// memory of time or rate would age. Cells would lose bonds to neighbors as if their cracks were smeared.
inline bool stays_while_others_break(Formulation formulation, const materials::AnyLaw& law) {
  const auto* rubber = std::get_if<materials::Hyperelastic>(&law);
  const bool ages = rubber ? rubber->kept() < 1 : !std::holds_alternative<materials::Elastic>(law);
  return formulation != Formulation::quadratic && !ages;
}

// By quadratic correspondence a crack by stretch does not take its fracture energy, but one that softens does; a metal
// that tears would need load steps that follow it down.
inline bool breaks_at_rest(Formulation formulation, const materials::AnyLaw& law, const DamageModel& damage) {
  if (damage.is_gradual) return formulation == Formulation::quadratic;
  return formulation != Formulation::quadratic && std::holds_alternative<materials::Elastic>(law) &&
         damage.critical_stretch && !damage.critical_stretch->depends_on_time();
}

// True if bonds of the block can break in equilibria.
bool breaks_at_rest(const MaterialBlock& block);

// The first reason in this body, such as "Symmetry Plane"; empty if there is none. Contact and tools are not
// considered.
std::string hindrance_of_breaks(const Body& body);

}  // namespace strut
