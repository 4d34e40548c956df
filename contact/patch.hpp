// A piece of a body that takes up friction. Friction acts at one place on both bodies, or it would turn them: at a
// place beside its points a piece goes as a rigid body would that moves as they do, and a force there is one at its
// middle and a couple. Both are each other's transpose, so that friction never does work on bodies that stick to each
// other there.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/math/tensors.hpp"

namespace strut::contact {

struct Patch {
  double weight = 0;                   // of all its points
  Vector middle = Vector::Zero();      // m
  Tensor per_couple = Tensor::Zero();  // θ of a couple: points feel it as the forces weight θ × (place − middle)
  double smallest = 0;                 // moment of its points about any axis, weight m²
  bool turns = false;                  // about any axis: its points are not in one row
  Vector row = Vector::Zero();  // of unit length along the row; zero where the patch turns, or is as good as one point
};

// The sums over the points of a patch; places are seen from one near them, m.
class PatchSums {
 public:
  void add(double weight, const Vector& place) {
    weight_ += weight;
    first_ += weight * place;
    second_ += weight * place * place.transpose();
  }

  Vector middle() const { return first_ / weight_; }  // of some weight

  // `arm`: how far from the middle friction acts, m. About an axis with a moment so small beside it that a force there
  // would meet next to no inertia, the patch does not turn.
  Patch patch(double arm) const {
    constexpr double most = 10;  // arm² in moments over weight: what is then felt there is as heavy as a point or more
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

 private:
  double weight_ = 0;
  Vector first_ = Vector::Zero();
  Tensor second_ = Tensor::Zero();
};

// The part of a force at `place` whose couple a patch takes up.
inline Vector bearable(const Patch& patch, const Vector& place, const Vector& force) {
  if (patch.turns) return force;
  const Vector arm = place - patch.middle;
  if (patch.row.isZero(0)) return arm.isZero(0) ? force : Vector(force.dot(arm) / arm.squaredNorm() * arm);
  const Vector turned = patch.row.cross(arm).stableNormalized();
  return force - force.dot(turned) * turned;
}

}  // namespace strut::contact
