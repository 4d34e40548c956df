// All contact laws. The type of the law is resolved once for all pairs of two blocks, not for each pair.
#pragma once

#include <cmath>
#include <numbers>
#include <variant>

#include "contact/laws/contact_law.hpp"
#include "contact/laws/surface.hpp"

namespace strut::contact {

// K_c = 18 K_p/(π δ⁵), Pa/m⁵.
inline double penalty_stiffness(double penalty, double horizon) {
  const double square = horizon * horizon;
  return 18 * penalty / (std::numbers::pi * square * square * horizon);
}

// The short-range penalty of Postek, Nowak & Pęcherski (2021), eq. 22: f = K_c (r − d) V₁ V₂, with d the distance of
// two points and r their touching distance; K_c is the mean of both points', as in Peridigm, where each point pushes.
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

// Points as elastic spheres (Hertz; Johnson, Contact Mechanics 1985, ch. 4): f = 4/3 E* √R* o^(3/2), with the overlap o
// and 1/R* = 1/R₁ + 1/R₂.
//
// R is half the edge of a cube with the volume of the point, so that neighbors on a lattice are touching spheres. Two
// faces of points with the spacing h then press each other with f/h² = 2/3 E* (o/h)^(3/2) for any spacing. Half the
// contact radius instead would make finer meshes stiffer, and would give all points of two blocks the same radius.
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

using PairLaw = std::variant<PenaltyLaw, HertzLaw>;  // between points
using Law = std::variant<PairLaw, SurfaceLaw>;

// Upper bound of the touching distance, m.
inline double radius_of(const Law& law) {
  if (const auto* surface = std::get_if<SurfaceLaw>(&law)) return surface->radius;
  return std::visit([](const ContactLaw auto& one) { return one.radius; }, std::get<PairLaw>(law));
}

// The contact model of two blocks.
struct Model {
  Law law;
  double friction = 0;  // Coulomb's coefficient
};

}  // namespace strut::contact
