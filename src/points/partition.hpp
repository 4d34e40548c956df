// Who owns which point: geometric partition and the order of points in memory.
#pragma once

#include "points/cloud.hpp"

namespace strut {

class Communicator;

struct Cuts {
  std::vector<double> costs;        // of a point of each block, in any unit: ranks get equal sums (empty: all alike)
  Vector lengths = Vector::Ones();  // how much a length along each axis counts: cuts go across the longest
};

// Collective. The same points, spread over the ranks by recursive coordinate bisection (Zoltan's RCB) and ordered on
// each rank along a space-filling curve, so that a family lies close together in memory.
PointCloud partitioned(const PointCloud& cloud, const Communicator& communicator, const Cuts& cuts = {});

// The points order[0], order[1], … of `cloud`.
PointCloud reordered(const PointCloud& cloud, const std::vector<int>& order);

}  // namespace strut
