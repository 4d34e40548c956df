// The short-range penalty of Postek, Nowak & Pęcherski (2021), eq. 22: f = K_c (r − d) V₁ V₂, with d the distance of
// two points and r their touching distance; K_c is the mean of both points', as in Peridigm, where each point pushes.
#pragma once

#include <numbers>

#include "contact/laws/contact_law.hpp"

namespace strut::contact {

// K_c = 18 K_p/(π δ⁵), Pa/m⁵.
inline double penalty_stiffness(double penalty, double horizon) {
  const double square = horizon * horizon;
  return 18 * penalty / (std::numbers::pi * square * square * horizon);
}

struct PenaltyLaw {
  double radius = 0;   // r_c, m
  double penalty = 0;  // K_p, Pa

  double touching_distance(const PointPair& pair) const {
    return largest_touching_distance(radius, pair.reference_distance, pair.one_body);
  }
  double normal_force(const PointPair& pair, double overlap) const {
    return tangent_stiffness(pair, overlap) * overlap;
  }
  double tangent_stiffness(const PointPair& pair, double) const {
    const auto& [first, second] = pair.horizons;
    const double one = penalty_stiffness(penalty, first);
    const double mean = first == second ? one : 0.5 * (one + penalty_stiffness(penalty, second));
    return mean * (pair.volumes[0] * pair.volumes[1]);
  }
  double stored_energy(const PointPair& pair, double overlap) const {
    return 0.5 * tangent_stiffness(pair, overlap) * overlap * overlap;
  }
};

static_assert(ContactLaw<PenaltyLaw>);

}  // namespace strut::contact
