// Where blocks are at the start and how fast they go: a forecast of who meets whom. Who is thrown at somebody later is
// not seen.
#pragma once

#include <optional>
#include <vector>

#include "base/math/tensors.hpp"
#include "setup/scene.hpp"

namespace strut {

// The first moment, over which prescribed displacements are looked at, as a part of the duration.
inline constexpr double first_moment = 1e-3;

// Where the points of a block are and how fast they go, over all ranks.
struct Trajectory {
  Eigen::AlignedBox3d places, velocities;
};

// Collective. One for each block; velocities are those of the start, initial and prescribed. `start`, `duration`: s.
std::vector<Trajectory> trajectories(const Scene& scene, double start, double duration);

// The first time in [0, duration] at which the bounding boxes overlap, moved on with these velocities.
std::optional<double> meeting_time(const Trajectory& a, const Trajectory& b, double duration);

}  // namespace strut
