// Initial cracks: no bond crosses them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "base/math/tensors.hpp"
#include "topology/mirror.hpp"

namespace strut {

struct RectangularCrack {
  Vector corner, normal, along;  // m; of length 1, at right angles
  double length, width;          // m: from the corner along `along`, and along the side, `along` × `normal`

  bool contains(const Vector& x) const {
    const Vector from = x - corner, side = along.cross(normal);
    return within(from.dot(along), length) && within(from.dot(side), width);
  }

 private:
  // A bond through the edge counts as crossing, to round-off.
  static bool within(double way, double most) { return way > -1e-12 * most && way < most * (1 + 1e-12); }
};

struct DiskCrack {
  Vector center, normal;  // m; of length 1
  double radius;          // m

  // A bond through the edge stays, to round-off, as in Peridigm.
  bool contains(const Vector& x) const { return (x - center).norm() < radius * (1 - 1e-12); }
};

// A surface of triangles.
struct TriangulatedCrack {
  std::vector<std::array<Vector, 3>> triangles;  // m
};

using Crack = std::variant<RectangularCrack, DiskCrack, TriangulatedCrack>;

// The side of a rectangle is `along` × `normal`, a cross product whose sign a reflection changes.
inline Crack image_of(const Crack& crack, const Reflection& by) {
  if (const auto* one = std::get_if<RectangularCrack>(&crack)) {
    const double sign = by.turn.determinant() < 0 ? -1 : 1;
    return RectangularCrack{by(one->corner), sign * (by.turn * one->normal), by.turn * one->along, one->length,
                            one->width};
  }
  if (const auto* surface = std::get_if<TriangulatedCrack>(&crack)) {
    TriangulatedCrack image = *surface;
    for (auto& triangle : image.triangles) {
      for (Vector& corner : triangle) corner = by(corner);
    }
    return image;
  }
  const DiskCrack& disk = std::get<DiskCrack>(crack);
  return DiskCrack{by(disk.center), by.turn * disk.normal, disk.radius};
}

// Intersection of the segment from a to b, ends included, with the plane through `on`, if there is one.
inline std::optional<Vector> crossing(const Vector& a, const Vector& b, const Vector& on, const Vector& normal) {
  const double way = (b - a).dot(normal);
  if (std::abs(way) < 1e-14 * (b - a).norm()) return std::nullopt;  // along the plane
  const double part = (on - a).dot(normal) / way;
  return part >= 0 && part <= 1 ? std::optional<Vector>(a + part * (b - a)) : std::nullopt;
}

// A bond through the edge counts as crossing, to round-off: no bond slips through between two triangles.
inline bool crosses(const std::array<Vector, 3>& triangle, const Vector& a, const Vector& b) {
  const Vector low = a.cwiseMin(b), high = a.cwiseMax(b),
               most = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]),
               least = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
  const double size = (most - least).norm(), margin = 1e-9 * size;
  if (((low - most).array() > margin).any() || ((least - high).array() > margin).any()) return false;
  const Vector u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], normal = u.cross(v);
  if (!(normal.norm() > 1e-12 * size * size)) return false;  // its corners are on a line
  const auto x = crossing(a, b, triangle[0], normal.normalized());
  if (!x) return false;
  const Vector from = *x - triangle[0];
  const double along_u = from.cross(v).dot(normal) / normal.squaredNorm(),
               along_v = u.cross(from).dot(normal) / normal.squaredNorm();
  constexpr double edge = 1e-12;
  return along_u > -edge && along_v > -edge && along_u + along_v < 1 + edge;
}

// True if the bond from a to b crosses the crack; symmetric in a and b.
inline bool crosses(const Crack& crack, const Vector& a, const Vector& b) {
  if (const auto* surface = std::get_if<TriangulatedCrack>(&crack)) {
    const bool in_order = std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    return std::ranges::any_of(surface->triangles, [&](const auto& triangle) {
      return in_order ? crosses(triangle, a, b) : crosses(triangle, b, a);
    });
  }
  const auto through = [&](const Vector& on, const auto& one) {
    const bool in_order = std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    const auto x = in_order ? crossing(a, b, on, one.normal) : crossing(b, a, on, one.normal);
    return x && one.contains(*x);
  };
  if (const auto* rectangle = std::get_if<RectangularCrack>(&crack)) return through(rectangle->corner, *rectangle);
  const DiskCrack& disk = std::get<DiskCrack>(crack);
  return through(disk.center, disk);
}

}  // namespace strut
