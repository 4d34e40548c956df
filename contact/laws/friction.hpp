// Coulomb friction.
#pragma once

#include <algorithm>

#include "base/math/tensors.hpp"

namespace strut::contact {

// The friction force on the first of two touching points, N. It acts along the tangential velocity of the second
// relative to the first, with μ times the normal force, or with the force that stops this velocity within dt if that is
// less. `normal`: of the touching surfaces, unit length, either sign. `mobility`: change of the relative velocity per
// unit of impulse between the two, 1/kg; with n contacts on each point, n₁/m₁ + n₂/m₂.
inline Vector friction_force(double coefficient, double normal_force, const Vector& relative_velocity,
                             const Vector& normal, double mobility, double dt) {
  const Vector sliding = relative_velocity - relative_velocity.dot(normal) * normal;
  const double speed = sliding.norm();
  if (speed == 0) return Vector::Zero();
  return std::min(coefficient * normal_force / speed, 1 / (mobility * dt)) * sliding;
}

// The force, N, of a spring (N/m) with this stretch (m); the stretch is reduced where the force exceeds `most` (N).
inline Vector yielding_spring(double most, double stiffness, Vector& stretch) {
  const double length = stretch.norm(), longest = most / stiffness;
  if (length > longest) stretch *= longest / length;
  return stiffness * stretch;
}

}  // namespace strut::contact
