// What two points do to each other when they come close: short-range penalty and Coulomb friction. Pure formulas.
#pragma once

#include <algorithm>
#include <numbers>

#include "base/math/tensors.hpp"

namespace strut::contact {

struct Model {
  double radius = 0;    // r_c, m
  double penalty = 0;   // K_p, Pa
  double friction = 0;  // Coulomb's coefficient
};

// K_c = 18 K_p/(π δ⁵), Pa/m⁵ (Postek, Nowak & Pęcherski 2021, eq. 22).
inline double penalty_stiffness(double penalty, double horizon) {
  const double square = horizon * horizon;
  return 18 * penalty / (std::numbers::pi * square * square * horizon);
}

// The distance at which two points begin to touch: r_c, but never more than a share of their distance in the reference
// state. Of one body: 0.9 of it (Parks et al. 2008, LAMMPS' PERI package). So a body does not start under pressure from
// points that are beyond each other's horizon but within r_c, and the material that joins two points is left to its own
// law until it has been shortened by a tenth. Of two bodies: all of it, so that bodies with a common face start without
// pressure and without a gap.
constexpr double reference_share = 0.9;
inline double touching_distance(double radius, double reference_distance, bool one_body) {
  return std::min(radius, (one_body ? reference_share : 1) * reference_distance);
}

// f = K_c (r_c − d) V₁ V₂ for d ≤ r_c, else 0, N (eq. 22). `stiffness`: K_c V₁ V₂, N/m.
inline double normal_force(double stiffness, double touching, double distance) {
  return stiffness * std::max(0.0, touching - distance);
}

// The energy that this force stores, J.
inline double stored_energy(double stiffness, double touching, double distance) {
  const double overlap = std::max(0.0, touching - distance);
  return 0.5 * stiffness * overlap * overlap;
}

// The force of friction on the first of two points, N. It drags along the tangential velocity of the second relative to
// the first, with μ times the normal force, or with what brings that velocity to zero within dt if that is less.
// `normal`: of the touching surfaces, unit length, either sign. `mobility`: velocity that a unit of impulse between
// the two takes from their relative one, 1/kg; with n contacts on each point, n₁/m₁ + n₂/m₂.
inline Vector friction_force(double coefficient, double normal_force, const Vector& relative_velocity,
                             const Vector& normal, double mobility, double dt) {
  const Vector sliding = relative_velocity - relative_velocity.dot(normal) * normal;
  const double speed = sliding.norm();
  if (speed == 0) return Vector::Zero();
  return std::min(coefficient * normal_force / speed, 1 / (mobility * dt)) * sliding;
}

}  // namespace strut::contact
