#include "conditions/crossing.hpp"

#include <algorithm>

namespace strut {

namespace {

constexpr double nearest_neighbors = 1.5;  // spacings: largest initial distance of the two points
constexpr double opposite = -0.5;          // n·n of normals more than 120 degrees apart
constexpr double least_depth = 1e-3;       // of a spacing: least depth in the tool

// The least gap on the segment from a to b, along which the gap is convex, by ternary search.
template <class S>
double least_gap(const S& shape, Vector a, Vector b) {
  for (int k = 0; k < 30; ++k) {
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
    const double h = domain.cloud.spacings[i];
    if (surface(shape, places[i] - offset).gap > 2 * nearest_neighbors * h) continue;
    domain.families.for_each(i, [&](int j) {
      const bool is_near = (domain.reference(j) - domain.reference(i)).norm() <= nearest_neighbors * h;
      if (is_near && is_between(shape, places[i] - offset, places[j] - offset, least_depth * h)) found = {i, j};
    });
    if (found.point >= 0) break;
  }
  return found;
}

}  // namespace

std::vector<Vector> present_places(const Domain& domain) {
  std::vector<Vector> places(domain.owned + domain.ghosts, Vector::Zero());
  for (int i = 0; i < domain.owned; ++i) places[i] = domain.current(i);
  domain.halo.exchange<reflect_place>(places);
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

}  // namespace strut
