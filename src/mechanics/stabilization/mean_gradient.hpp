// A spring on the residual of the mean deformation gradient of both ends, z = η − ½ (F_i + F_j) ξ, which is zero for
// any quadratic motion inside the body: the same noise is held down at a fraction of the false stiffness of Silling's.
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
