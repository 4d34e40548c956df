// The shapes of rigid tools, and the distance of a position from their surfaces.
#pragma once

#include <variant>

#include "base/math/tensors.hpp"

namespace strut {

// The half-space behind a plane.
struct HalfSpace {
  Vector point;   // m
  Vector normal;  // of unit length, out of the tool
};

// A cylinder without ends.
struct Cylinder {
  Vector point;   // on the axis, m
  Vector axis;    // of unit length
  double radius;  // m
};

// A solid block with faces across the coordinate axes and sharp edges.
struct Box {
  Vector lower, upper;  // corners, m; lower < upper in each component
};

using Shape = std::variant<HalfSpace, Cylinder, Box>;

// The signed distance of a position from a shape, and its derivatives by the position.
struct Surface {
  double gap;        // to the nearest point of the surface, m; negative inside
  Vector normal;     // ∂gap/∂x: of unit length, out of the tool
  Tensor curvature;  // ∂normal/∂x, 1/m; zero for plane faces
};

// If there are several nearest points, one is chosen, always the same: on the axis of a cylinder the normal is the
// coordinate axis most orthogonal to it, made exactly orthogonal, and the infinite curvature is set to zero; for
// equally near faces of a box, the first of low x, high x, low y, high y, low z, high z.
//
// All three shapes are convex, and so is the distance from a convex body (Boyd & Vandenberghe 2004, 3.2.5): gap +
// normal · step is never more than the gap after the step. A step that keeps it nonnegative stays outside.
inline Surface surface(const HalfSpace& half, const Vector& place) {
  return {half.normal.dot(place - half.point), half.normal, Tensor::Zero()};
}
Surface surface(const Cylinder& cylinder, const Vector& place);
Surface surface(const Box& box, const Vector& place);
Surface surface(const Shape& shape, const Vector& place);

// The number of steps along a direction that takes a position nearest to the middle of a shape: its point, axis or
// plane.
double steps_to(const Shape& shape, const Vector& place, const Vector& step);

// The accuracy of directions and relative positions that decks give by their digits.
constexpr double digits_of_decks = 1e-5;

// True if a shape is its own mirror image by the plane with the unit normal n through a point.
bool is_own_image(const Shape& shape, const Vector& on, const Vector& n);

}  // namespace strut
