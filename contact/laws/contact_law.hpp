// What a law of contact is: the touching distance of two points, and from their overlap the force that parts them, its
// slope and the energy that it stores. A new law is a type of its own (penalty.hpp, hertz.hpp), a line in laws.hpp, and
// an entry in src/deck/sections/contact_laws.cpp.
#pragma once

#include <algorithm>
#include <concepts>
#include <utility>

namespace strut::contact {

// Two points that are near each other, as a law sees them: the same from both.
struct PointPair {
  double volumes[2];                   // in the reference state, m³
  std::pair<double, double> horizons;  // m
  double reference_distance;           // m
  bool one_body;                       // or two: then they are not bonded wherever they are
};

// No two points touch from farther than this, whatever the law (the search rests on it): r_c, but never more than a
// share of their distance in the reference state. Of one body: 0.9 of it (Parks et al. 2008, LAMMPS' PERI package). So
// a body does not start under pressure from points that are beyond each other's horizon but within r_c, and the
// material that joins two points is left to its own law until it has been shortened by a tenth. Of two bodies: all of
// it, so that bodies with a common face start without pressure and without a gap.
inline constexpr double reference_share = 0.9;
inline double largest_touching_distance(double radius, double reference_distance, bool one_body) {
  return std::min(radius, (one_body ? reference_share : 1) * reference_distance);
}

// With `overlap`, m: by how much two points are nearer than their touching distance; never negative. The stiffness may
// not fall as the overlap grows (forces.cpp bounds that of the next step), and is not less than 0 where there is none.
template <class L>
concept ContactLaw = std::copyable<L> && requires(const L& law, const PointPair& pair, double overlap) {
  { law.radius } -> std::convertible_to<double>;                     // r_c, m
  { law.touching_distance(pair) } -> std::same_as<double>;           // m: the largest one, or less
  { law.normal_force(pair, overlap) } -> std::same_as<double>;       // N, > 0 parts them
  { law.tangent_stiffness(pair, overlap) } -> std::same_as<double>;  // the slope of the force, N/m
  { law.stored_energy(pair, overlap) } -> std::same_as<double>;      // its integral from 0 on, J
};

}  // namespace strut::contact
