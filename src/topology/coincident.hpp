// Points that are at one place: what is given twice.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/parallel/communicator.hpp"
#include "topology/cloud.hpp"

namespace strut {

// Nearer to each other than this, in the edge of a cube of the smaller one's volume, two points are at one place: most
// of the one's cell is in the other's. Cells that lie side by side are so near where they are 30 times as wide as
// thick.
constexpr double at_one_place = 0.1;

// Collective, of a cloud that is spread over the ranks in any way. `allowed`: whether points of these two blocks may be
// at one place. "" where no others are; else a sentence, the same on all ranks, that names the first two by the order
// of the file and says how many there are.
std::string coincident_points(const PointCloud& cloud, const Communicator& communicator,
                              const std::function<bool(int, int)>& allowed);

}  // namespace strut
