// Coincident points: input that is given twice.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/parallel/communicator.hpp"
#include "topology/cloud.hpp"

namespace strut {

// Two points coincide if their distance is below this, in units of the edge of a cube with the volume of the smaller
// point: their cells then overlap for the most part. Cells that lie side by side can be so near only if they are 30
// times as wide as thick.
constexpr double at_one_place = 0.1;

// Collective, for a cloud in any distribution over the ranks. `allowed`: whether points of these two blocks may
// coincide. Returns "" if no other points coincide; else a sentence, the same on all ranks, with the first two of them
// in the order of the file and the number of points.
std::string coincident_points(const PointCloud& cloud, const Communicator& communicator,
                              const std::function<bool(int, int)>& allowed);

}  // namespace strut
