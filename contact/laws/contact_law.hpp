// Interface of a contact law between points: the touching distance of two points and, as functions of their overlap,
// the repulsive force, its slope and the stored energy. A new law needs a type and a word in laws.hpp, and an
// entry in src/deck/sections/contact.cpp.
#pragma once

#include <algorithm>
#include <concepts>
#include <utility>

#include "base/math/tensors.hpp"

namespace strut::contact {

// A pair of points as a law sees it, symmetric in both.
struct PointPair {
  double volumes[2];                   // in the reference state, m³
  std::pair<double, double> horizons;  // m
  double reference_distance;           // m
  bool one_body;                       // false: points of two bodies, which are never bonded
};

// Upper bound of the touching distance for any law (the search relies on it): r_c, limited to a fraction of the
// reference distance. Within a body the fraction is 0.9 (Parks et al. 2008, LAMMPS' PERI package), so that a body does
// not start under pressure from points beyond each other's horizon but within r_c, and the material between two points
// follows its own law until it is compressed by a tenth. Between two bodies it is 1, so that bodies with a common face
// start without pressure and without a gap.
inline constexpr double reference_fraction = 0.9;
inline double largest_touching_distance(double radius, double reference_distance, bool one_body) {
  return std::min(radius, (one_body ? reference_fraction : 1) * reference_distance);
}

// `overlap`: touching distance minus distance, m, never negative. The stiffness must not decrease as the overlap grows
// (forces.cpp bounds that of the next step), and must not be negative at zero overlap.
template <class L>
concept ContactLaw = std::copyable<L> && requires(const L& law, const PointPair& pair, double overlap) {
  { law.radius } -> std::convertible_to<double>;                     // r_c, m
  { law.touching_distance(pair) } -> std::same_as<double>;           // m, at most the largest one
  { law.normal_force(pair, overlap) } -> std::same_as<double>;       // N, repulsive if > 0
  { law.tangent_stiffness(pair, overlap) } -> std::same_as<double>;  // the slope of the force, N/m
  { law.stored_energy(pair, overlap) } -> std::same_as<double>;      // its integral from 0 on, J
};

// The force of Coulomb friction on the first of two touching points, N. It acts along the tangential velocity of the
// second relative to the first (m/s), with μ times the normal force (N), or with the force that stops this velocity
// within dt (s) if that is less. `normal`: of the touching surfaces, unit length, either sign. `mobility`: change of
// the relative velocity per unit of impulse between the two, 1/kg; with n contacts on each point, n₁/m₁ + n₂/m₂.
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
