// A spring on the component along the bond of the residual of the mean deformation gradient of both ends.
#pragma once

#include "mechanics/stabilization/residual.hpp"

namespace strut {

struct AlongBondsStabilization {
  static constexpr const char* name = "Along Bonds";
  static constexpr ResidualKind residual = ResidualKind::both_gradients;
  double coefficient = 0;

  // t = C (z·ξ) ξ/|ξ|²: linear in z, with a symmetric derivative.
  template <class Scalar, class Residual, class Bond>
  static Residual bond_force(const Scalar& C, const Residual& z, const Bond& xi) {
    const auto length2 = xi.c[0] * xi.c[0] + xi.c[1] * xi.c[1] + xi.c[2] * xi.c[2] + 1e-300;  // 0 of the point itself
    const Scalar along = C * (z.c[0] * xi.c[0] + z.c[1] * xi.c[1] + z.c[2] * xi.c[2]) / length2;
    return {{along * xi.c[0], along * xi.c[1], along * xi.c[2]}};
  }
};

}  // namespace strut
