#include "setup/undeclared_contact.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

#include "points/bounding_box.hpp"

namespace strut {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Where the points of a block are and how fast they go, over all ranks.
struct Trajectory {
  Eigen::AlignedBox3d places, velocities;
};

constexpr double short_part = 1e-3;  // of the duration: over which prescribed displacements are looked at

std::vector<Trajectory> trajectories(const Scene& scene, double start, double duration) {
  const Domain& domain = scene.body.domain;
  std::vector<Trajectory> all(domain.cloud.block_names.size());
  const std::vector<Vector> velocities =
      predicted_velocities(scene.conditions, start, short_part * duration, scene.body);
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

// The first time in [0, duration] at which the boxes overlap.
std::optional<double> meeting_time(const Trajectory& a, const Trajectory& b, double duration) {
  if (a.places.isEmpty() || b.places.isEmpty()) return std::nullopt;
  double from = 0, to = duration;
  for (int c = 0; c < 3; ++c) {
    restrict_to_overlap(a.places.min()[c] - b.places.max()[c], a.velocities.min()[c] - b.velocities.max()[c], from, to);
    restrict_to_overlap(b.places.min()[c] - a.places.max()[c], b.velocities.min()[c] - a.velocities.max()[c], from, to);
  }
  return from <= to ? std::optional(from) : std::nullopt;
}

bool may_be_bonded(const BlockHorizons& one, const BlockHorizons& other, double gap) {
  return one.body == other.body && gap <= 0.5 * (one.largest + other.largest);
}

bool declared(const std::vector<contact::Interaction>& interactions, int a, int b) {
  return std::any_of(interactions.begin(), interactions.end(), [&](const contact::Interaction& one) {
    return std::minmax(one.first, one.second) == std::minmax(a, b);
  });
}

}  // namespace

std::string undeclared_contacts(const Scene& scene, const std::vector<contact::Interaction>& interactions, double start,
                                double duration) {
  const Domain& domain = scene.body.domain;
  const std::vector<Trajectory> all = trajectories(scene, start, duration);
  std::ostringstream text;
  for (int a = 0; a < static_cast<int>(all.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(all.size()); ++b) {
      const double gap = all[a].places.exteriorDistance(all[b].places);
      if (declared(interactions, a, b) || may_be_bonded(domain.blocks[a], domain.blocks[b], gap)) continue;
      const auto time = meeting_time(all[a], all[b], duration);
      if (!time) continue;
      text << "WARNING: blocks " << domain.cloud.block_names[a] << " and " << domain.cloud.block_names[b]
           << " meet at about t = " << start + *time
           << " s and will pass through each other: no contact between them is "
           << "declared (Contact > Interactions)\n";
    }
  }
  return text.str();
}

}  // namespace strut
