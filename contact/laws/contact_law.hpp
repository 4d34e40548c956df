// Interface of a contact law between points: the touching distance of two points and, as functions of their overlap,
// the repulsive force, its slope and the stored energy. A new law needs a type of its own (penalty.hpp, hertz.hpp), a
// line in laws.hpp and an entry in src/deck/sections/contact_laws.cpp.
#pragma once

#include <algorithm>
#include <concepts>
#include <utility>

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
inline constexpr double reference_share = 0.9;
inline double largest_touching_distance(double radius, double reference_distance, bool one_body) {
  return std::min(radius, (one_body ? reference_share : 1) * reference_distance);
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

}  // namespace strut::contact
