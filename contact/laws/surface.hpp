// Contact between surfaces. It is defined by a smoothed volume fraction of the other body,
//   ρ(x) = Σ V_j W(|y_j − x|),  W(r) = 45045/(4096 π R³) (1 − r²/R²)⁶ with the integral 1,
// which goes from 0 to 1 across a flat face and hardly shows the lattice; V_j is corrected so that it does so across a
// curved face, too (contact/own_surface.hpp). A point touches if ρ exceeds the value that it has at the distance e from
// a flat face, e the depth of the point below the surface of its own body. The overlap g is that excess divided by the
// slope of ρ, and the pressure
//   p(g) = K g, or K g/(1 − g/g_l) with a largest overlap g_l,
// is the derivative of an energy per area, so that forces derive from it, too (contact/surfaces.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strut::contact {

// The reach R in spacings. Two equal lattices slide on each other with slopes below 1 % (docs/theory.md); a smaller
// reach shows the lattice, a larger one blunts the surfaces of thin members.
inline constexpr double reach_in_spacings = 2.5;

// W as a function of r², r < `reach`, and its slope divided by r, which is finite at r = 0.
class Smoothing {
 public:
  explicit Smoothing(double reach)
      : inverse2_(1 / (reach * reach)), norm_(45045 / (4096 * std::numbers::pi) * inverse2_ / reach) {}

  double value(double r2) const { return norm_ * power(r2, 6); }                                  // 1/m³
  double slope_over_distance(double r2) const { return -12 * norm_ * inverse2_ * power(r2, 5); }  // 1/m⁵

 private:
  double power(double r2, int n) const {
    const double x = 1 - r2 * inverse2_, square = x * x;
    return square * square * (n == 6 ? square : x);
  }

  double inverse2_, norm_;
};

// The smoothed volume fraction before a flat face of a body on a lattice.
struct Face {
  double reach;    // R, m
  double spacing;  // of its layers, m
  bool is_middle;  // its points are centers of cells, half a spacing behind the face; else nodes, of which those on the
                   // face have half a volume

  // ρ at the distance d from the face, and −dρ/dd, 1/m.
  double volume_fraction(double d) const {
    return over_layers(d, [this](double x) { return 6435.0 / 4096 / reach * std::pow(x, 7); });
  }
  double slope(double d) const {
    const double factor = 6435.0 / 4096 * 14 / (reach * reach * reach);
    return over_layers(d, [&, this](double x) { return factor * reach * std::sqrt(1 - x) * std::pow(x, 6); });
  }

 private:
  // `of_layer`: a function of 1 − z²/R² for a layer at the distance z.
  template <class OfLayer>
  double over_layers(double d, const OfLayer& of_layer) const {
    const auto at = [&](double z) { return of_layer(1 - z * z / (reach * reach)); };
    double sum = is_middle ? 0 : -0.5 * at(d);
    for (double z = is_middle ? d + 0.5 * spacing : d; z < reach; z += spacing) sum += at(z);
    return spacing * sum;
  }
};

struct SurfaceLaw {
  double factor = 0.25;        // of the stiffness of a layer one spacing thick
  double largest_overlap = 0;  // of a spacing; 0: no limit
  // Set from the two blocks, at set-up.
  double modulus = 0;  // M*, Pa: 1/M* = (1/M₁ + 1/M₂)/2, M of longitudinal waves
  double radius = 0;   // m: largest distance at which a point may see another body
  double spacing = 0;  // m: the mean of the largest spacings of both

  double stiffness() const { return factor * modulus / spacing; }  // K, Pa/m: of two faces
  double limit() const { return largest_overlap * spacing; }       // g_l, m

  // Functions of the overlap g, m. Near the limit, which a step may exceed, p continues along its tangent.
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
