// The shapes of rigid tools, and how far away from their surfaces a place is.
#pragma once

#include <variant>

#include "base/math/tensors.hpp"

namespace strut {

// All that is behind a plane.
struct HalfSpace {
  Vector point;   // m
  Vector normal;  // of unit length, out of the tool
};

// Without ends.
struct Cylinder {
  Vector point;   // on the axis, m
  Vector axis;    // of unit length
  double radius;  // m
};

// A solid block with faces across the axes of coordinates and sharp edges.
struct Box {
  Vector lower, upper;  // corners, m; lower < upper in each component
};

using Shape = std::variant<HalfSpace, Cylinder, Box>;

// What a place sees of a shape: the signed distance and its derivatives with respect to the place.
struct Surface {
  double gap;        // to the nearest point of the surface, m; negative inside
  Vector normal;     // ∂gap/∂x: of unit length, out of the tool
  Tensor curvature;  // ∂normal/∂x, 1/m; zero for plane faces
};

// Where nearest points are several, one is chosen, the same always: on the axis of a cylinder the normal is the axis of
// coordinates that is most across it, made so entirely, and the curvature, infinite there, zero; in a box of equally
// near faces the first of low x, high x, low y, high y, low z, high z.
//
// All three shapes are convex, and so is the distance from a convex body (Boyd & Vandenberghe 2004, 3.2.5): gap +
// normal · step is never more than the gap after the step. Who keeps the former from being negative is outside.
inline Surface surface(const HalfSpace& half, const Vector& place) {
  return {half.normal.dot(place - half.point), half.normal, Tensor::Zero()};
}
Surface surface(const Cylinder& cylinder, const Vector& place);
Surface surface(const Box& box, const Vector& place);
Surface surface(const Shape& shape, const Vector& place);

}  // namespace strut
