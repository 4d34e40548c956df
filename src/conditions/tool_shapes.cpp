#include "conditions/tool_shapes.hpp"

#include <cmath>
#include <limits>

namespace strut {

namespace {

// The coordinate axis most orthogonal to `axis`, the first of equals, made exactly orthogonal.
Vector across(const Vector& axis) {
  int most = 0;
  for (int c = 1; c < 3; ++c) {
    if (std::abs(axis[c]) < std::abs(axis[most])) most = c;
  }
  const Vector unit = Vector::Unit(most);
  return (unit - axis.dot(unit) * axis).normalized();
}

// The surface from a position inside or on it: the nearest face.
Surface nearest_face(const Box& box, const Vector& place) {
  Surface nearest{-std::numeric_limits<double>::infinity(), {}, Tensor::Zero()};
  for (int c = 0; c < 3; ++c) {
    for (const double side : {-1.0, 1.0}) {
      const double gap = side < 0 ? box.lower[c] - place[c] : place[c] - box.upper[c];
      if (gap <= nearest.gap) continue;
      nearest.gap = gap;
      nearest.normal = side * Vector::Unit(c);
    }
  }
  return nearest;
}

}  // namespace

// The curvature across the axis is one over the distance from it; along the axis it is zero.
Surface surface(const Cylinder& cylinder, const Vector& place) {
  const Vector& a = cylinder.axis;
  const Vector from_point = place - cylinder.point;
  const Vector from_axis = from_point - a.dot(from_point) * a;
  const double distance = from_axis.norm();
  if (distance == 0) return {-cylinder.radius, across(a), Tensor::Zero()};
  const Vector n = from_axis / distance;
  const Tensor turning = Tensor::Identity() - n * n.transpose() - a * a.transpose();
  return {distance - cylinder.radius, n, turning / distance};
}

// From outside, the normal rotates around the nearest point in the directions in which the position is beyond the box:
// none at a face, the plane across an edge, all at a corner.
Surface surface(const Box& box, const Vector& place) {
  const Vector beyond = place - place.cwiseMax(box.lower).cwiseMin(box.upper);
  const double distance = beyond.norm();
  if (distance == 0) return nearest_face(box, place);
  const Vector n = beyond / distance;
  Tensor turning = -n * n.transpose();
  for (int c = 0; c < 3; ++c) turning(c, c) += beyond[c] != 0 ? 1 : 0;
  return {distance, n, turning / distance};
}

namespace {

bool is_own_image(const HalfSpace& half, const Vector&, const Vector& n) {
  return std::abs(half.normal.dot(n)) < digits_of_decks;
}

bool is_own_image(const Cylinder& cylinder, const Vector& on, const Vector& n) {
  const double along = std::abs(cylinder.axis.dot(n));
  const bool is_in_plane =
      along < digits_of_decks && std::abs(n.dot(cylinder.point - on)) < digits_of_decks * cylinder.radius;
  return is_in_plane || along > 1 - digits_of_decks * digits_of_decks;
}

// Its corners are those of its image.
bool is_own_image(const Box& box, const Vector& on, const Vector& n) {
  const Vector middle = 0.5 * (box.lower + box.upper), half = 0.5 * (box.upper - box.lower);
  for (int corner = 0; corner < 8; ++corner) {
    const Vector signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Vector place = middle + half.cwiseProduct(signs), image = place - 2 * n.dot(place - on) * n;
    if (((image - middle).cwiseAbs() - half).norm() > digits_of_decks * half.minCoeff()) return false;
  }
  return true;
}

}  // namespace

bool is_own_image(const Shape& shape, const Vector& on, const Vector& n) {
  return std::visit([&](const auto& one) { return is_own_image(one, on, n); }, shape);
}

namespace {

Vector from_middle(const HalfSpace& half, const Vector& place) {
  return half.normal.dot(place - half.point) * half.normal;
}
Vector from_middle(const Cylinder& cylinder, const Vector& place) {
  const Vector from_point = place - cylinder.point;
  return from_point - cylinder.axis.dot(from_point) * cylinder.axis;
}
Vector from_middle(const Box& box, const Vector& place) { return place - 0.5 * (box.lower + box.upper); }

}  // namespace

double steps_to(const Shape& shape, const Vector& place, const Vector& step) {
  return std::visit(
      [&](const auto& one) {
        const Vector from = from_middle(one, place), across = from_middle(one, place + step) - from;
        const bool is_along = across.norm() < digits_of_decks * step.norm();  // every step sees the same
        return is_along ? 0 : -std::nearbyint(from.dot(across) / across.squaredNorm());
      },
      shape);
}

Surface surface(const Shape& shape, const Vector& place) {
  return std::visit([&](const auto& one) { return surface(one, place); }, shape);
}

}  // namespace strut
