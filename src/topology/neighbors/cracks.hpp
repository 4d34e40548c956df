// Flat initial cracks: no bond crosses them.
#pragma once

#include <algorithm>
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

using Crack = std::variant<RectangularCrack, DiskCrack>;

// The side of a rectangle is `along` × `normal`, a cross product whose sign a reflection changes.
inline Crack image_of(const Crack& crack, const Reflection& by) {
  if (const auto* one = std::get_if<RectangularCrack>(&crack)) {
    const double sign = by.turn.determinant() < 0 ? -1 : 1;
    return RectangularCrack{by(one->corner), sign * (by.turn * one->normal), by.turn * one->along, one->length,
                            one->width};
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

// True if the bond from a to b crosses the crack; symmetric in a and b.
inline bool crosses(const Crack& crack, const Vector& a, const Vector& b) {
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
