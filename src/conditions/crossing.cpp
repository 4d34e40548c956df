#include "conditions/crossing.hpp"

#include <algorithm>
#include <cmath>

#include "topology/cell_edges.hpp"

namespace strut {

namespace {

constexpr double nearest_neighbors = 1.5;  // the cell's edges: largest initial distance of the two points
constexpr double opposite = -0.5;          // n·n of normals more than 120 degrees apart
constexpr double least_depth = 1e-3;       // of a spacing: least depth in the tool

// The least gap on the segment from a to b, along which the gap is convex, by ternary search.
template <class S>
double least_gap(const S& shape, Vector a, Vector b, int thirds = 30) {
  for (int k = 0; k < thirds; ++k) {
    const Vector low = a + (b - a) / 3, high = b - (b - a) / 3;
    if (surface(shape, low).gap < surface(shape, high).gap) {
      b = high;
    } else {
      a = low;
    }
  }
  return surface(shape, 0.5 * (a + b)).gap;
}

template <class S>
bool is_between(const S& shape, const Vector& a, const Vector& b, double depth) {
  const Surface here = surface(shape, a), there = surface(shape, b);
  return here.gap < (b - a).norm() && here.normal.dot(there.normal) < opposite && least_gap(shape, a, b) < -depth;
}

template <class S>
Crossing crossing_of(const S& shape, const RigidTool& tool, const Vector& offset, const Domain& domain,
                     const std::vector<Vector>& places) {
  Crossing found;
  for (const int i : tool.points) {
    const double h = domain.cloud.spacings[i], longest = edges_of_cell(domain, i).longest;
    const Vector here = tool.nearest_image(domain, places[i] - offset);
    if (surface(shape, here).gap > 2 * nearest_neighbors * longest) continue;
    domain.families.for_each(i, [&](int j) {
      const Vector xi = domain.reference(j) - domain.reference(i);
      const bool is_near = xi.norm() <= nearest_neighbors * std::max(h, edge_of_cell(domain, i, xi.normalized()));
      if (is_near && is_between(shape, here, here + places[j] - places[i], least_depth * h)) found = {i, j};
    });
    if (found.point >= 0) break;
  }
  return found;
}

}  // namespace

std::vector<Vector> present_positions(const Domain& domain) {
  std::vector<Vector> places(domain.owned + domain.ghosts, Vector::Zero());
  for (int i = 0; i < domain.owned; ++i) places[i] = domain.current(i);
  domain.halo.exchange<reflect_position>(places);
  return places;
}

std::optional<Crossing> find_crossing(const RigidTool& tool, double t, const Domain& domain,
                                      const std::vector<Vector>& places) {
  const Vector offset = tool.offset(t);
  Crossing found =
      std::visit([&](const auto& shape) { return crossing_of(shape, tool, offset, domain, places); }, tool.shape);
  const int rank = domain.communicator.rank();
  const double teller = domain.communicator.max(found.point >= 0 ? rank : -1.0);
  if (teller < 0) return std::nullopt;
  if (teller != rank) found = {};
  return found;
}

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

// Rolls have no ends: those that are not parallel to a plane meet it somewhere.
double gap(const Cylinder& roll, const HalfSpace& half) {
  const bool parallel = std::abs(roll.axis.dot(half.normal)) < digits_of_decks;
  return parallel ? surface(half, roll.point).gap - roll.radius : -1;
}

double gap(const Cylinder& roll, const Cylinder& other) {
  const Vector between = other.point - roll.point, across = roll.axis.cross(other.axis);
  const bool parallel = across.norm() < digits_of_decks;
  const double apart = parallel ? between.cross(roll.axis).norm() : std::abs(between.dot(across.normalized()));
  return apart - roll.radius - other.radius;
}

// The distance from a convex shape is a convex function along the axis: ternary search finds its minimum, which is
// where a point of the box is projected.
double gap(const Cylinder& roll, const Box& box) {
  const Vector center = 0.5 * (box.lower + box.upper);
  const Vector middle = roll.point + roll.axis * roll.axis.dot(center - roll.point);
  const Vector reach = roll.axis * (box.upper - box.lower).norm();
  return least_gap(box, middle - reach, middle + reach, 100) - roll.radius;
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
  if (const auto* roll = std::get_if<Cylinder>(&one)) {
    return std::visit([roll](const auto& shape) { return gap(*roll, shape); }, other);
  }
  if (std::holds_alternative<Cylinder>(other)) return gap(other, one);
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
