#include "conditions/tool_gap.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

namespace {

Shape moved(const Shape& shape, const Vector& by) {
  Shape there = shape;
  if (auto* box = std::get_if<Box>(&there)) {
    box->lower += by, box->upper += by;
  } else {
    std::visit(
        [&](auto& one) {
          if constexpr (requires { one.point; }) one.point += by;
        },
        there);
  }
  return there;
}

// The distance from a convex shape is a convex function along the axis: ternary search finds its minimum.
double gap(const Cylinder& roll, const Shape& other) {
  constexpr double far = 1e4;  // m, longer than any tool
  const auto from = [&](double s) { return surface(other, Vector(roll.point + s * roll.axis)).gap; };
  double low = -far, high = far;
  for (int n = 0; n < 200; ++n) {
    const double third = (high - low) / 3;
    if (from(low + third) < from(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return from(0.5 * (low + high)) - roll.radius;
}

double gap(const HalfSpace& half, const HalfSpace& other) {
  constexpr double parallel = 1e-9;
  const bool opposite = half.normal.dot(other.normal) < -1 + parallel;
  return opposite ? half.normal.dot(other.point - half.point) : -1;
}

double gap(const Box& box, const HalfSpace& half) {
  const Vector nearest = (half.normal.array() > 0).select(box.lower.array(), box.upper.array()).matrix();
  return half.normal.dot(nearest - half.point);
}

// The gap between faces across one axis. It underestimates the distance of edges that pass each other diagonally.
double gap(const Box& box, const Box& other) {
  return (box.lower - other.upper).cwiseMax(other.lower - box.upper).maxCoeff();
}

double gap(const Shape& one, const Shape& other) {
  if (const auto* roll = std::get_if<Cylinder>(&one)) return gap(*roll, other);
  if (std::holds_alternative<Cylinder>(other)) return gap(std::get<Cylinder>(other), one);
  if (const auto* box = std::get_if<Box>(&one)) {
    if (const auto* half = std::get_if<HalfSpace>(&other)) return gap(*box, *half);
    return gap(*box, std::get<Box>(other));
  }
  if (std::holds_alternative<Box>(other)) return gap(std::get<Box>(other), std::get<HalfSpace>(one));
  return gap(std::get<HalfSpace>(one), std::get<HalfSpace>(other));
}

}  // namespace

double gap_between(const RigidTool& one, const RigidTool& other, double t) {
  return gap(moved(one.shape, one.offset(t)), moved(other.shape, other.offset(t)));
}

}  // namespace strut
