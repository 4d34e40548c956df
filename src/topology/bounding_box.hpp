// Bounding boxes of points, also of points spread over the ranks.
#pragma once

#include <span>

#include "base/math/tensors.hpp"
#include "base/parallel/communicator.hpp"

namespace strut {

inline Eigen::AlignedBox3d box_around(std::span<const Vector> points) {
  Eigen::AlignedBox3d box;
  for (const Vector& x : points) box.extend(x);
  return box;
}

// Collective. The box that contains the boxes of all ranks; empty if all of them are.
inline Eigen::AlignedBox3d common_box(const Eigen::AlignedBox3d& mine, const Communicator& communicator) {
  double bounds[6];
  for (int c = 0; c < 3; ++c) bounds[c] = mine.max()[c], bounds[3 + c] = -mine.min()[c];
  communicator.max(bounds);
  return {-Vector(bounds[3], bounds[4], bounds[5]), Vector(bounds[0], bounds[1], bounds[2])};
}

}  // namespace strut
