// Silling's stabilization (2017): a spring on the residual of each end's own deformation gradient, with the energy
// ½ C_i Σ ω V_j |η − F_i ξ|² per point. A smooth gradient of strain stores energy in it, too.
#pragma once

#include "mechanics/stabilization/residual.hpp"

namespace strut {

struct SillingStabilization {
  static constexpr const char* name = "Silling";
  static constexpr ResidualKind residual = ResidualKind::own_gradient;
  double coefficient = 0;
};

}  // namespace strut
