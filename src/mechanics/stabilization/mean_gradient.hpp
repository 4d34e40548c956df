// A spring on the residual of the mean deformation gradient of both ends, z = η − ½ (F_i + F_j) ξ. It vanishes for any
// quadratic motion inside the body, so it suppresses the same noise with a fraction of the artificial stiffness that
// Silling's has.
#pragma once

#include "mechanics/stabilization/residual.hpp"

namespace strut {

struct MeanGradientStabilization {
  static constexpr const char* name = "Mean Gradient";
  static constexpr ResidualKind residual = ResidualKind::both_gradients;
  double coefficient = 0;

  template <class Scalar, class Residual, class Bond>
  static Residual bond_force(const Scalar& C, const Residual& z, const Bond&) {
    return {{C * z.c[0], C * z.c[1], C * z.c[2]}};
  }
};

}  // namespace strut
