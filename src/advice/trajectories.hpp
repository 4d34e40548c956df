// Initial positions and velocities of blocks, for a forecast of their meetings. Blocks thrown at each other later are
// not found.
#pragma once

#include <optional>
#include <vector>

#include "base/math/tensors.hpp"
#include "setup/scene.hpp"

namespace strut {

// The first moment, over which prescribed displacements are evaluated, as a fraction of the duration.
inline constexpr double first_moment = 1e-3;

// The boxes of a block's positions, of its cells, and of its velocities, over all ranks.
struct Trajectory {
  Eigen::AlignedBox3d places, cells, velocities;
};

// Collective. One for each block; initial and prescribed velocities of the start. `start`, `duration`: s.
std::vector<Trajectory> trajectories(const Scene& scene, double start, double duration);

// The first time in [0, duration] at which the boxes of cells, moved with these velocities, overlap; s. Those that
// touch at the start meet only if they go on to overlap.
std::optional<double> meeting_time(const Trajectory& a, const Trajectory& b, double duration);

}  // namespace strut
