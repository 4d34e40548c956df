// Contact between surfaces. What is around a place is told by a smooth share of the other body's material,
//   ρ(x) = Σ V_j W(|y_j − x|),
// with Wendland's C⁴ function W (Wendland, Adv. Comput. Math. 4, 1995), whose integral is 1: ρ goes from 0 to 1 across a
// flat face, and hardly shows the lattice behind it. A point touches where ρ exceeds what a face has at the distance e,
// by which the point's own cell reaches beyond it. The overlap g is that excess over the slope of ρ, and the pressure
//   p(g) = K g, or K g/(1 − g/g_l), where there is a largest overlap g_l,
// is the derivative of an energy a face, so that forces derive from it too (contact/surfaces.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strut::contact {

// With this reach of W in spacings a body slides over another of an equal lattice with a slope of 0.1 % (see
// docs/theory.md); with less the lattice shows, with more the surfaces of thin members become blunt.
inline constexpr double reach_in_spacings = 2.5;

// W of a distance r and its slope over r, where r < `reach`.
class Smoothing {
 public:
  explicit Smoothing(double reach) : inverse_(1 / reach), norm_(495 / (32 * std::numbers::pi) * cubed(inverse_)) {}

  double value(double r) const {  // 1/m³
    const double q = r * inverse_, p = 1 - q;
    return norm_ * cubed(p) * cubed(p) * (1 + q * (6 + 35.0 / 3 * q));
  }
  double slope_over_distance(double r) const {  // W'(r)/r, 1/m⁵: finite at r = 0
    const double q = r * inverse_, p = 1 - q;
    return -56.0 / 3 * norm_ * inverse_ * inverse_ * p * p * cubed(p) * (1 + 5 * q);
  }

 private:
  static double cubed(double x) { return x * x * x; }

  double inverse_, norm_;
};

// ∫ W dA over a plane at the distance d < reach, 1/m: the slope of ρ before a face.
inline double over_plane(double reach, double d) {
  const double p = 1 - std::min(1.0, d / reach);
  return 495.0 / 16 / reach * std::pow(p, 7) * (8.0 / 3 + p * (-6 + p * (41.0 / 9 - 7.0 / 6 * p)));
}

// ρ at the distance d before the face of a lattice of this spacing, whose first points are `first` behind the face: half
// a spacing (middles of cells) or 0 (nodes, of which those on the face have half a volume).
inline double before_face(double reach, double d, double spacing, double first) {
  double share = first > 0 ? 0 : -0.5 * over_plane(reach, d);
  for (double z = d + first; z < reach; z += spacing) share += over_plane(reach, z);
  return spacing * share;
}

struct SurfaceLaw {
  double factor = 0.25;         // of the stiffness of a layer one spacing thick
  double largest_overlap = 0;   // of a spacing; 0: no limit
  // As the two blocks have it (setup).
  double modulus = 0;           // M*, Pa: 1/M* = (1/M₁ + 1/M₂)/2, M of longitudinal waves
  double radius = 0;            // m: from where a point may see another body
  double spacing = 0;           // the mean of both blocks', m

  double stiffness() const { return factor * modulus / spacing; }  // K, Pa/m: of two faces
  double limit() const { return largest_overlap * spacing; }       // g_l, m

  // Of the overlap g, m. Near the limit, where a step may go beyond it, p goes on along its tangent.
  double pressure(double g) const {  // Pa
    if (limit() == 0) return stiffness() * g;
    const double near = std::min(g, most * limit());
    return near * part(near) * stiffness() + (g - near) * slope(near);
  }
  double slope(double g) const {  // Pa/m
    if (limit() == 0) return stiffness();
    const double left = part(std::min(g, most * limit()));
    return stiffness() * left * left;
  }
  double energy(double g) const {  // J/m²
    if (limit() == 0) return 0.5 * stiffness() * g * g;
    const double near = std::min(g, most * limit()), beyond = g - near, x = near / limit();
    return stiffness() * limit() * limit() * (-x - std::log1p(-x)) +
           beyond * (pressure(near) + 0.5 * beyond * slope(near));
  }

 private:
  static constexpr double most = 0.95;
  double part(double g) const { return 1 / (1 - g / limit()); }
};

}  // namespace strut::contact
