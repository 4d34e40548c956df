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

}  // namespace

std::vector<Trajectory> trajectories(const Scene& scene, double start, double duration) {
  const Domain& domain = scene.body.domain;
  std::vector<Trajectory> all(domain.cloud.block_names.size());
  const std::vector<Vector> velocities =
      predicted_velocities(scene.conditions, start, first_moment * duration, scene.body);
  for (int i = 0; i < domain.owned; ++i) {
    all[domain.cloud.blocks[i]].places.extend(scene.body.current(i));
    all[domain.cloud.blocks[i]].velocities.extend(velocities[i]);
  }
  for (Trajectory& trajectory : all) {
    for (Eigen::AlignedBox3d* box : {&trajectory.places, &trajectory.velocities})
      *box = common_box(*box, domain.communicator);
  }
  return all;
}

std::optional<double> meeting_time(const Trajectory& a, const Trajectory& b, double duration) {
  if (a.places.isEmpty() || b.places.isEmpty()) return std::nullopt;
  double from = 0, to = duration;
  for (int c = 0; c < 3; ++c) {
    restrict_to_overlap(a.places.min()[c] - b.places.max()[c], a.velocities.min()[c] - b.velocities.max()[c], from, to);
    restrict_to_overlap(b.places.min()[c] - a.places.max()[c], b.velocities.min()[c] - a.velocities.max()[c], from, to);
  }
  return from <= to ? std::optional(from) : std::nullopt;
}

}  // namespace strut
