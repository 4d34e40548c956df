#include "advice/trajectories.hpp"

#include <algorithm>
#include <limits>

#include "topology/bounding_box.hpp"

namespace strut {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Restricts the interval [from, to] to the times at which distance + speed t ≤ 0.
void restrict_to_overlap(double distance, double speed, double& from, double& to) {
  if (speed == 0) {
    if (distance > 0) to = -infinity;
  } else if (speed < 0) {
    from = std::max(from, -distance / speed);
  } else {
    to = std::min(to, -distance / speed);
  }
}

// The same along one axis, for a block below another one. Cells that are no boxes are known by their moments, so that
// those that touch may seem to overlap: points then count, unless these come a tenth of their distance nearer.
void restrict_to_overlap(const Trajectory& low, const Trajectory& high, int axis, double duration, double& from,
                         double& to) {
  constexpr double much = 0.1;
  const double apart = high.cells.min()[axis] - low.cells.max()[axis];
  const double of_points = high.places.min()[axis] - low.places.max()[axis];
  const double speed = high.velocities.min()[axis] - low.velocities.max()[axis];
  const bool touch = of_points > 0 && apart < 1e-6 * of_points, stay = -speed * duration < much * of_points;
  restrict_to_overlap(!touch ? apart : stay ? of_points : 0, speed, from, to);
}

}  // namespace

std::vector<Trajectory> trajectories(const Scene& scene, double start, double duration) {
  const Domain& domain = scene.body.domain;
  std::vector<Trajectory> all(domain.cloud.block_names.size());
  const std::vector<Vector> velocities =
      predicted_velocities(scene.conditions, start, first_moment * duration, scene.body);
  for (int i = 0; i < domain.owned; ++i) {
    Trajectory& trajectory = all[domain.cloud.blocks[i]];
    const Vector place = scene.body.current(i);
    trajectory.places.extend(place);
    trajectory.velocities.extend(velocities[i]);
    for (const Vector direction : {Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()}) {
      const auto reach = [&](const Vector& to) { return reach_of_cell(domain.cloud, domain.volume(i), i, to); };
      trajectory.cells.extend(place + reach(direction) * direction);
      trajectory.cells.extend(place - reach(-direction) * direction);
    }
  }
  for (Trajectory& trajectory : all) {
    for (Eigen::AlignedBox3d* box : {&trajectory.places, &trajectory.cells, &trajectory.velocities})
      *box = common_box(*box, domain.communicator);
  }
  return all;
}

std::optional<double> meeting_time(const Trajectory& a, const Trajectory& b, double duration) {
  if (a.places.isEmpty() || b.places.isEmpty()) return std::nullopt;
  double from = 0, to = duration;
  for (int c = 0; c < 3; ++c) {
    restrict_to_overlap(b, a, c, duration, from, to);
    restrict_to_overlap(a, b, c, duration, from, to);
  }
  return from <= to ? std::optional(from) : std::nullopt;
}

}  // namespace strut
