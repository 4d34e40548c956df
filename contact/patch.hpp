// A patch: a piece of a body that takes friction as a whole. Friction acts at one position on both bodies, else it
// would rotate them. Off its points a patch moves like a rigid body with the mean motion of its points, and a force
// there acts as a force at its center and a couple. Motion and force are transposes of each other, so friction does no
// work on bodies that stick to each other.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/math/tensors.hpp"

namespace strut::contact {

struct Patch {
  double weight = 0;                   // of all its points
  Vector middle = Vector::Zero();      // m
  Tensor per_couple = Tensor::Zero();  // rotation θ per couple: points get the forces weight θ × (position − middle)
  double smallest = 0;                 // smallest moment of its points about any axis, weight m²
  bool turns = false;                  // about any axis: its points are not in one line
  Vector row = Vector::Zero();         // unit vector along the line; zero if the patch turns, or is like one point
};

// Sums over the points of a patch; positions are relative to one near them, m.
class PatchSums {
 public:
  void add(double weight, const Vector& place) {
    weight_ += weight;
    first_ += weight * place;
    second_ += weight * place * place.transpose();
  }

  Vector middle() const { return first_ / weight_; }  // some weight must have been added

  // `arm`: distance from the center at which friction acts, m. The patch does not turn about an axis whose moment is so
  // small compared with it that a force there would meet almost no inertia.
  Patch patch(double arm) const {
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

 private:
  double weight_ = 0;
  Vector first_ = Vector::Zero();
  Tensor second_ = Tensor::Zero();
};

// The part of a force at `place` whose couple a patch can take.
inline Vector bearable(const Patch& patch, const Vector& place, const Vector& force) {
  if (patch.turns) return force;
  const Vector arm = place - patch.middle;
  if (patch.row.isZero(0)) return arm.isZero(0) ? force : Vector(force.dot(arm) / arm.squaredNorm() * arm);
  const Vector turned = patch.row.cross(arm).stableNormalized();
  return force - force.dot(turned) * turned;
}

}  // namespace strut::contact
