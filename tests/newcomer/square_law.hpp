// A contact law whose force grows with the square of the overlap: f = k o².
#pragma once

#include "contact/laws/contact_law.hpp"

namespace strut::contact {

struct SquareLaw {
  double radius = 0;     // r_c, m
  double stiffness = 0;  // k, N/m²

  double touching_distance(const PointPair& pair) const {
    return largest_touching_distance(radius, pair.reference_distance, pair.one_body);
  }
  double normal_force(const PointPair&, double overlap) const { return stiffness * overlap * overlap; }
  double tangent_stiffness(const PointPair&, double overlap) const { return 2 * stiffness * overlap; }
  double stored_energy(const PointPair&, double overlap) const { return stiffness / 3 * overlap * overlap * overlap; }
};

static_assert(ContactLaw<SquareLaw>);

}  // namespace strut::contact
