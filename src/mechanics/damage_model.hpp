// The criterion by which the bonds of a block break.
#pragma once

#include <optional>

#include "base/math/function.hpp"
#include "materials/failure_criterion.hpp"

namespace strut {

// A bond breaks if its stretch, |η|/|ξ| − 1, or the energy that it stores in tension exceeds the critical value (the
// lesser of its two ends'), or if one of its ends has failed.
struct DamageModel {
  std::optional<Function> critical_stretch = {};  // s_c(t); ignored if the fracture energy is given
  // G_c, J/m²: s_c (or w_c) is chosen so that pulling two halves of the block apart dissipates G_c per area of the
  // plane between them.
  double fracture_energy = 0;
  // The stress of integration points falls gradually beside a crack (materials/brittle.hpp), from G_c.
  bool is_gradual = false;
  std::optional<materials::Ductility> ductility = {};  // failure criterion of points, if the metal of the block flows
  // w_c, J/m⁶, for ordinary blocks: energy per product of both ends' volumes; ignored if the fracture energy is given.
  std::optional<double> critical_bond_energy = {};
};

}  // namespace strut
