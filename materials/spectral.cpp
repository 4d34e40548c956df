#include "materials/spectral.hpp"

#include <limits>

namespace strut::materials {

Principal principal(const Symmetric& s) {
  const Tensor none = Tensor::Constant(std::numeric_limits<double>::quiet_NaN());
  if (!s.allFinite()) return {none.col(0), none};
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(to_tensor(s));
  if (solver.info() != Eigen::Success) return {none.col(0), none};
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Symmetric from_principal(const Vector& values, const Tensor& axes) {
  return symmetric_part(axes * values.asDiagonal() * axes.transpose());
}

Symmetric exponential(const Symmetric& s) {
  const Principal found = principal(s);
  return from_principal(found.values.array().exp(), found.axes);
}

}  // namespace strut::materials
