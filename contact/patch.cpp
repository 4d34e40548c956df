#include "contact/patch.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace strut::contact {

void PatchSums::add(double weight, const Vector& place) {
  weight_ += weight;
  first_ += weight * place;
  second_ += weight * place * place.transpose();
}

Patch PatchSums::patch(double arm) const {
  constexpr double most = 10;  // largest arm²/(moment/weight): the effective mass at the arm is at least a point's
  Patch patch;
  if (!(weight_ > 0)) return patch;
  patch.weight = weight_;
  patch.middle = middle();
  const Tensor spread = second_ - weight_ * patch.middle * patch.middle.transpose();
  const Eigen::SelfAdjointEigenSolver<Tensor> axes(spread);
  const Vector along = axes.eigenvalues().cwiseMax(0), moments = Vector::Constant(along.sum()) - along;
  const double least = std::max(weight_ * arm * arm / most, 1e-9 * second_.trace());
  if (!(moments[1] > least)) return patch;
  patch.smallest = moments[2];
  patch.turns = patch.smallest > least;
  if (!patch.turns) patch.row = axes.eigenvectors().col(2);
  for (int c = 0; c < (patch.turns ? 3 : 2); ++c) {
    const Vector axis = axes.eigenvectors().col(c);
    patch.per_couple += axis * axis.transpose() / moments[c];
  }
  return patch;
}

Vector bearable(const Patch& patch, const Vector& place, const Vector& force) {
  if (patch.turns) return force;
  const Vector arm = place - patch.middle;
  if (patch.row.isZero(0)) return arm.isZero(0) ? force : Vector(force.dot(arm) / arm.squaredNorm() * arm);
  const Vector turned = patch.row.cross(arm).stableNormalized();
  return force - force.dot(turned) * turned;
}

}  // namespace strut::contact
