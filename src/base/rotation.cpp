#include "base/rotation.hpp"

#include <cmath>

namespace strut {

namespace {

// ε_ikj A_jk: twice the axial vector of the skew part of A.
Vector axial(const Tensor& a) { return {a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1)}; }

// The rotation whose axis is h and whose angle is 2 atan |h| (Rodrigues' parameters, the Cayley transform).
Tensor rotation_of(const Vector& h) {
  const double squared = h.squaredNorm();
  Tensor cross;
  cross << 0, -h[2], h[1], h[2], 0, -h[0], -h[1], h[0], 0;
  return ((1 - squared) * Tensor::Identity() + 2 * h * h.transpose() + 2 * cross) / (1 + squared);
}

}  // namespace

Tensor updated_rotation(const Tensor& rotation, const Tensor& deformation_gradient) {
  const Tensor stretch = deformation_gradient * rotation.transpose();  // V, up to the rotation of this step
  const Tensor symmetric = 0.5 * (stretch + stretch.transpose());
  const Tensor defect = symmetric.trace() * Tensor::Identity() - symmetric;
  const Vector tangent = defect.inverse() * axial(stretch);  // tan of the angle, about its axis
  return rotation_of(tangent / (1 + std::sqrt(1 + tangent.squaredNorm()))) * rotation;
}

}  // namespace strut
