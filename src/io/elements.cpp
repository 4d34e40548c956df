#include "io/elements.hpp"

#include <cmath>
#include <numbers>

namespace strut::io {

namespace {

constexpr int corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

// At one Gauss point: the shape functions, and det ∂x/∂ξ.
struct GaussPoint {
  std::array<double, 8> shape;
  double weight;
};

GaussPoint gauss_point(const int (&g)[3], std::span<const Vector, 8> nodes) {
  const double gauss = 1 / std::sqrt(3.0);
  GaussPoint point{};
  Tensor jacobian = Tensor::Zero();
  for (int n = 0; n < 8; ++n) {
    const auto& c = corner[n];
    const double a = 1 + c[0] * g[0] * gauss;
    const double b = 1 + c[1] * g[1] * gauss;
    const double d = 1 + c[2] * g[2] * gauss;
    point.shape[n] = a * b * d / 8;
    jacobian += nodes[n] * Vector(c[0] * b * d, a * c[1] * d, a * b * c[2]).transpose() / 8;
  }
  point.weight = jacobian.determinant();
  return point;
}

}  // namespace

// x and the shape functions are trilinear in the local coordinates ξ and det ∂x/∂ξ is at most quadratic in each, so
// that the integrals of det, of x det and of N det are at most cubic in each ξ: two Gauss points an axis are exact for
// them, whatever the distortion.
ElementPoint hexahedron(std::span<const Vector, 8> nodes) {
  ElementPoint point{Vector::Zero(), 0};
  for (const auto& g : corner) {
    const GaussPoint at = gauss_point(g, nodes);
    Vector x = Vector::Zero();
    for (int n = 0; n < 8; ++n) x += at.shape[n] * nodes[n];
    point.volume += at.weight;
    point.centroid += at.weight * (x - nodes[0]);  // about a corner: far from the origin nothing cancels
  }
  point.centroid = nodes[0] + point.centroid / point.volume;
  return point;
}

std::array<double, 8> hexahedron_parts(std::span<const Vector, 8> nodes) {
  std::array<double, 8> parts{};
  for (const auto& g : corner) {
    const GaussPoint at = gauss_point(g, nodes);
    for (int n = 0; n < 8; ++n) parts[n] += at.shape[n] * at.weight;
  }
  return parts;
}

ElementPoint tetrahedron(std::span<const Vector, 4> nodes) {
  const Vector a = nodes[1] - nodes[0];
  const Vector b = nodes[2] - nodes[0];
  const Vector c = nodes[3] - nodes[0];
  return {(nodes[0] + nodes[1] + nodes[2] + nodes[3]) / 4, a.cross(b).dot(c) / 6};
}

std::array<double, 4> tetrahedron_parts(std::span<const Vector, 4> nodes) {
  const double part = tetrahedron(nodes).volume / 4;
  return {part, part, part, part};
}

double sphere_volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

double sphere_radius(double volume) { return std::cbrt(3 * volume / (4 * std::numbers::pi)); }

}  // namespace strut::io
