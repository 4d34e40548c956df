// From a reader on rank 0 to slices on all ranks.
#pragma once

#include "base/parallel/communicator.hpp"
#include "points/cloud.hpp"

namespace strut::io {

// Collective. `whole` holds all points on rank 0 and nothing elsewhere; each rank receives a contiguous slice of them,
// and the names.
PointCloud distribute(const PointCloud& whole, const Communicator& communicator);

}  // namespace strut::io
