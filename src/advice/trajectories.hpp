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

// Two blocks in coordinates along other axes, the columns.
struct View {
  Tensor axes = Tensor::Identity();
  Trajectory a, b;
};

// Collective. Two blocks that have points, along the axes of space, those of either block, and the line between their
// centers: boxes along the first overlap where bodies that are turned are apart.
std::vector<View> views_of(const Body& body, const std::vector<Trajectory>& all, int a, int b);

// The first time in [0, duration] at which the boxes of cells, moved with these velocities, overlap; s. Those that
// touch at the start meet only if they go on to overlap.
std::optional<double> meeting_time(const Trajectory& a, const Trajectory& b, double duration);

// The same of boxes that overlap in all of these views, the second block shifted.
std::optional<double> meeting_time(const std::vector<View>& views, double duration,
                                   const Vector& shift = Vector::Zero());

}  // namespace strut
