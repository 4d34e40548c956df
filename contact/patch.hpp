// A patch: a piece of a body that takes friction as a whole. Friction acts at one position on both bodies, else it
// would rotate them. Off its points a patch moves like a rigid body with the mean motion of its points, and a force
// there acts as a force at its center and a couple. Motion and force are transposes of each other, so friction does no
// work on bodies that stick to each other.
#pragma once

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
  void add(double weight, const Vector& place);
  Vector middle() const { return first_ / weight_; }  // some weight must have been added

  // `arm`: distance from the center at which friction acts, m. The patch does not turn about an axis whose moment is so
  // small compared with it that a force there would meet almost no inertia.
  Patch patch(double arm) const;

 private:
  double weight_ = 0;
  Vector first_ = Vector::Zero();
  Tensor second_ = Tensor::Zero();
};

// The part of a force at `place` whose couple a patch can take.
Vector bearable(const Patch& patch, const Vector& place, const Vector& force);

}  // namespace strut::contact
