#include "topology/neighbors/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace strut {
namespace {

// A bond through the edge counts as crossing, to round-off.
bool within(double distance, double most) { return distance > -1e-12 * most && distance < most * (1 + 1e-12); }

bool contains(const RectangularCrack& crack, const Vector& x) {
  const Vector from = x - crack.corner, side = crack.along.cross(crack.normal);
  return within(from.dot(crack.along), crack.length) && within(from.dot(side), crack.width);
}

// A bond through the edge stays, to round-off, as in Peridigm.
bool contains(const DiskCrack& crack, const Vector& x) {
  return (x - crack.center).norm() < crack.radius * (1 - 1e-12);
}

// Intersection of the segment from a to b, ends included, with the plane through `on`, if there is one. Ends that are
// on the plane to the round-off of meshes are on it: else bonds of a layer of points there would be cut at random.
std::optional<Vector> crossing(const Vector& a, const Vector& b, const Vector& on, const Vector& normal) {
  const double from = (a - on).dot(normal), to = (b - on).dot(normal), least = 1e-9 * (b - a).norm();
  const bool starts_on = std::abs(from) <= least, ends_on = std::abs(to) <= least;
  if (starts_on) return ends_on ? std::nullopt : std::optional<Vector>(a);  // both: along the plane
  if (ends_on) return b;
  return (from > 0) != (to > 0) ? std::optional<Vector>(a + from / (from - to) * (b - a)) : std::nullopt;
}

// A bond through the edge counts as crossing, to round-off: no bond slips through between two triangles.
bool crosses(const std::array<Vector, 3>& triangle, const Vector& a, const Vector& b) {
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

}  // namespace

// The side of a rectangle is `along` × `normal`, a cross product whose sign a reflection changes.
Crack image_of(const Crack& crack, const Reflection& by) {
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

bool crosses(const Crack& crack, const Vector& a, const Vector& b) {
  if (const auto* surface = std::get_if<TriangulatedCrack>(&crack)) {
    const bool in_order = std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    return std::ranges::any_of(surface->triangles, [&](const auto& triangle) {
      return in_order ? crosses(triangle, a, b) : crosses(triangle, b, a);
    });
  }
  const auto through = [&](const Vector& on, const auto& one) {
    const bool in_order = std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    const auto x = in_order ? crossing(a, b, on, one.normal) : crossing(b, a, on, one.normal);
    return x && contains(one, *x);
  };
  if (const auto* rectangle = std::get_if<RectangularCrack>(&crack)) return through(rectangle->corner, *rectangle);
  const DiskCrack& disk = std::get<DiskCrack>(crack);
  return through(disk.center, disk);
}

}  // namespace strut
