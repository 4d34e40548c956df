#include "io/exodus/elements.hpp"

#include <cmath>
#include <numbers>

namespace strut::io {

namespace {

constexpr int corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

// Shape functions and weight times det ∂x/∂ξ at one position in the local coordinates.
struct GaussPoint {
  std::array<double, 8> shape;
  double weight;
};

GaussPoint at_place(const Vector& place, std::span<const Vector, 8> nodes) {
  GaussPoint point{};
  Tensor jacobian = Tensor::Zero();
  for (int n = 0; n < 8; ++n) {
    const auto& c = corner[n];
    const double a = 1 + c[0] * place[0];
    const double b = 1 + c[1] * place[1];
    const double d = 1 + c[2] * place[2];
    point.shape[n] = a * b * d / 8;
    jacobian += nodes[n] * Vector(c[0] * b * d, a * c[1] * d, a * b * c[2]).transpose() / 8;
  }
  point.weight = jacobian.determinant();
  return point;
}

GaussPoint gauss_point(const int (&g)[3], std::span<const Vector, 8> nodes) {
  const double gauss = 1 / std::sqrt(3.0);
  return at_place(Vector(g[0] * gauss, g[1] * gauss, g[2] * gauss), nodes);
}

Symmetric squared(const Vector& r) {
  return {r[0] * r[0], r[1] * r[1], r[2] * r[2], r[0] * r[1], r[1] * r[2], r[2] * r[0]};
}

Vector position(const GaussPoint& at, std::span<const Vector, 8> nodes) {
  Vector x = Vector::Zero();
  for (int n = 0; n < 8; ++n) x += at.shape[n] * nodes[n];
  return x;
}

// Integrals over the cube of half an edge `half` around `middle` in the local coordinates. x⊗x det ∂x/∂ξ has at most
// degree 4 in each of them, and three Gauss points per axis are exact up to degree 5.
Integrals over_cube(const Vector& middle, double half, std::span<const Vector, 8> nodes, const Vector& origin) {
  const double places[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weights[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  Integrals sum;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        const GaussPoint at = at_place(middle + half * Vector(places[i], places[j], places[k]), nodes);
        const double part = weights[i] * weights[j] * weights[k] * half * half * half * at.weight;
        const Vector r = position(at, nodes) - origin;
        sum += {part, part * r, part * squared(r)};
      }
    }
  }
  return sum;
}

}  // namespace

// x and the shape functions are trilinear in the local coordinates ξ, and det ∂x/∂ξ is at most quadratic in each. So
// the integrals of det, of x det and of N det are at most cubic in each ξ, and two Gauss points per axis are exact for
// them, whatever the distortion.
ElementPoint hexahedron(std::span<const Vector, 8> nodes) {
  ElementPoint point{Vector::Zero(), 0};
  for (const auto& g : corner) {
    const GaussPoint at = gauss_point(g, nodes);
    point.volume += at.weight;
    // Relative to a corner, so that digits do not cancel far from the origin.
    point.centroid += at.weight * (position(at, nodes) - nodes[0]);
  }
  point.centroid = nodes[0] + point.centroid / point.volume;
  return point;
}

int folded_corner(std::span<const Vector, 8> nodes) {
  constexpr double rounding = 1e-6;  // of the mean: for collapsed corners, and for coordinates in single precision
  double mean = 0;
  for (const auto& g : corner) mean += gauss_point(g, nodes).weight / 8;
  for (int n = 0; n < 8; ++n) {
    const Vector place(corner[n][0], corner[n][1], corner[n][2]);
    if (at_place(place, nodes).weight < -rounding * std::abs(mean)) return n;
  }
  return -1;
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

Integrals& Integrals::operator+=(const Integrals& other) {
  volume += other.volume;
  first += other.first;
  second += other.second;
  return *this;
}

CellShape cell_shape(const Integrals& integrals) {
  CellShape shape;
  shape.offset = integrals.first / integrals.volume;
  shape.moments = integrals.second / integrals.volume - squared(shape.offset);
  return shape;
}

Symmetric hexahedron_moments(std::span<const Vector, 8> nodes) {
  return cell_shape(over_cube(Vector::Zero(), 1, nodes, hexahedron(nodes).centroid)).moments;
}

// For any simplex: Σ (x_node − x̄)⊗(x_node − x̄) / ((d + 1)(d + 2)) with d = 3.
Symmetric tetrahedron_moments(std::span<const Vector, 4> nodes) {
  const Vector centroid = tetrahedron(nodes).centroid;
  Symmetric sum = Symmetric::Zero();
  for (const Vector& node : nodes) sum += squared(node - centroid);
  return sum / 20;
}

Symmetric cube_moments(double volume) { return spherical(std::cbrt(volume * volume) / 12); }

std::array<Integrals, 8> hexahedron_pieces(std::span<const Vector, 8> nodes) {
  std::array<Integrals, 8> pieces;
  for (int n = 0; n < 8; ++n) {
    pieces[n] = over_cube(0.5 * Vector(corner[n][0], corner[n][1], corner[n][2]), 0.5, nodes, nodes[n]);
  }
  return pieces;
}

// All faces of a quarter are plane, so the hexahedron of its eight corners fills it.
std::array<Integrals, 4> tetrahedron_pieces(std::span<const Vector, 4> nodes) {
  constexpr int turned[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};  // each right-handed
  std::array<Integrals, 4> pieces;
  for (const auto& order : turned) {
    const Vector &a = nodes[order[0]], &b = nodes[order[1]], &c = nodes[order[2]], &d = nodes[order[3]];
    const std::array<Vector, 8> corners = {a,           (a + b) / 2,     (a + b + c) / 3,     (a + c) / 2,
                                           (a + d) / 2, (a + b + d) / 3, (a + b + c + d) / 4, (a + c + d) / 3};
    pieces[order[0]] = over_cube(Vector::Zero(), 1, corners, a);
  }
  return pieces;
}

double sphere_volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

double sphere_radius(double volume) { return std::cbrt(3 * volume / (4 * std::numbers::pi)); }

}  // namespace strut::io
