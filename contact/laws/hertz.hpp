// Points as elastic spheres (Hertz; Johnson, Contact Mechanics 1985, ch. 4): f = 4/3 E* √R* o^(3/2), with the overlap o
// and 1/R* = 1/R₁ + 1/R₂.
//
// R is half the edge of a cube with the volume of the point, so that neighbors on a lattice are touching spheres. Two
// faces of points with the spacing h then press each other with f/h² = 2/3 E* (o/h)^(3/2) for any spacing. Half the
// contact radius instead would make finer meshes stiffer, and would give all points of two blocks the same radius.
#pragma once

#include <cmath>

#include "contact/laws/contact_law.hpp"

namespace strut::contact {

struct HertzLaw {
  double radius = 0;             // r_c, m: distance at which points may touch, not a radius of spheres
  double effective_modulus = 0;  // E*, Pa: 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂

  // R*, m.
  static double effective_radius(const PointPair& pair) {
    const double one = 0.5 * std::cbrt(pair.volumes[0]), other = 0.5 * std::cbrt(pair.volumes[1]);
    return one * other / (one + other);
  }
  double touching_distance(const PointPair& pair) const {
    return largest_touching_distance(radius, pair.reference_distance, pair.one_body);
  }
  double normal_force(const PointPair& pair, double overlap) const {
    return 2.0 / 3 * tangent_stiffness(pair, overlap) * overlap;
  }
  double tangent_stiffness(const PointPair& pair, double overlap) const {
    return 2 * effective_modulus * std::sqrt(effective_radius(pair) * overlap);
  }
  double stored_energy(const PointPair& pair, double overlap) const {
    return 4.0 / 15 * tangent_stiffness(pair, overlap) * overlap * overlap;
  }
};

static_assert(ContactLaw<HertzLaw>);

}  // namespace strut::contact
