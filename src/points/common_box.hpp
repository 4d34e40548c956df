// The bounding box of points that are spread over ranks.
#pragma once

#include "base/communicator.hpp"
#include "base/tensors.hpp"

namespace strut {

// Collective. The box that holds the boxes of all ranks; empty where all of them are.
inline Eigen::AlignedBox3d common_box(const Eigen::AlignedBox3d& mine, const Communicator& communicator) {
  double bounds[6];
  for (int c = 0; c < 3; ++c) bounds[c] = mine.max()[c], bounds[3 + c] = -mine.min()[c];
  communicator.max(bounds);
  return {-Vector(bounds[3], bounds[4], bounds[5]), Vector(bounds[0], bounds[1], bounds[2])};
}

}  // namespace strut
