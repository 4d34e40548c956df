// Initial positions and velocities of blocks, for a forecast of their meetings, and the displacements of points whose
// motion is prescribed. Blocks thrown at each other later are not found.
#pragma once

#include <optional>
#include <vector>

#include "base/math/tensors.hpp"
#include "setup/scene.hpp"

namespace strut {

// The first moment, over which prescribed displacements are evaluated, as a fraction of the duration.
inline constexpr double first_moment = 1e-3;

// The boxes of a block's positions, of its cells, of its velocities, and of the displacements of its points from their
// places at the start in the whole run, over all ranks: as prescribed, else at the velocities of the start.
struct Trajectory {
  Eigen::AlignedBox3d places, cells, velocities, displacements;
};

// The trajectory of an image, m away.
Trajectory shifted(Trajectory trajectory, const Vector& by);

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
// touch at the start meet only if they go on to overlap, and none whose displacements are too short.
std::optional<double> meeting_time(const Trajectory& a, const Trajectory& b, double duration);

// The first time in [0, duration] at which the boxes of cells overlap in all of these views, s; the second block is
// shifted by `shift`, m.
std::optional<double> meeting_time(const std::vector<View>& views, double duration, const Vector& shift);

// Displacements of points by conditions up to `time`, which is `step` after the last call; velocities are integrated.
void move_on(const Conditions& conditions, const Domain& domain, double time, double step,
             std::vector<Vector>& displacements);

// The times at which paths are looked at, from the start on, s: evenly, and some of those where they turn or jump.
std::vector<double> sample_times(std::vector<double> changes, double start, double duration);

}  // namespace strut
