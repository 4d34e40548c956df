// When the bonds of a block break.
#pragma once

#include <optional>

#include "base/math/function.hpp"
#include "materials/failure_criterion.hpp"

namespace strut {

// A bond breaks where its stretch, |η|/|ξ| − 1, or the energy that it holds while it is stretched exceeds a critical
// one, the lesser of its two ends', or where one of its ends has failed.
struct DamageModel {
  std::optional<Function> critical_stretch = {};  // s_c(t); ignored where the fracture energy is given
  // G_c, J/m²: s_c (or w_c) is such that two halves of the block that are pulled apart dissipate it on the plane
  // between them.
  double fracture_energy = 0;
  std::optional<materials::Ductility> ductility = {};  // of a block whose metal flows: when its points fail
  // w_c, J/m⁶, of an ordinary block: for the volumes of both ends; ignored where the fracture energy is given.
  std::optional<double> critical_bond_energy = {};
};

}  // namespace strut
