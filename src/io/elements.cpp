#include "io/elements.hpp"

#include <cmath>
#include <numbers>

namespace strut::io {

// x is trilinear in the local coordinates ξ and det ∂x/∂ξ is at most quadratic in each, so that both integrals, of det
// and of x det, are at most cubic in each ξ: two Gauss points an axis are exact for them, whatever the distortion.
ElementPoint hexahedron(std::span<const Vector, 8> nodes) {
  constexpr int corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const double gauss = 1 / std::sqrt(3.0);
  ElementPoint point{Vector::Zero(), 0};
  for (const auto& g : corner) {
    Vector x = Vector::Zero();
    Tensor jacobian = Tensor::Zero();
    for (int n = 0; n < 8; ++n) {
      const auto& c = corner[n];
      const double a = 1 + c[0] * g[0] * gauss;
      const double b = 1 + c[1] * g[1] * gauss;
      const double d = 1 + c[2] * g[2] * gauss;
      x += a * b * d / 8 * nodes[n];
      jacobian += nodes[n] * Vector(c[0] * b * d, a * c[1] * d, a * b * c[2]).transpose() / 8;
    }
    const double weight = jacobian.determinant();
    point.volume += weight;
    point.centroid += weight * (x - nodes[0]);  // about a corner: far from the origin nothing cancels
  }
  point.centroid = nodes[0] + point.centroid / point.volume;
  return point;
}

ElementPoint tetrahedron(std::span<const Vector, 4> nodes) {
  const Vector a = nodes[1] - nodes[0];
  const Vector b = nodes[2] - nodes[0];
  const Vector c = nodes[3] - nodes[0];
  return {(nodes[0] + nodes[1] + nodes[2] + nodes[3]) / 4, a.cross(b).dot(c) / 6};
}

double sphere_volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

double sphere_radius(double volume) { return std::cbrt(3 * volume / (4 * std::numbers::pi)); }

}  // namespace strut::io
