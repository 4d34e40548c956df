// Who owns which point: geometric partition and the order of points in memory.
#pragma once

#include "topology/cloud.hpp"

namespace strut {

class Communicator;

struct Cuts {
  std::vector<double> costs;        // of a point of each block, in any unit: ranks get equal sums (empty: all alike)
  Vector lengths = Vector::Ones();  // how much a length along each axis counts: cuts go across the longest
};

// Collective. The rank on which each point is to be, by recursive coordinate bisection (Zoltan's RCB). `costs`: of each
// point, in any unit.
std::vector<int> bisected(const PointCloud& cloud, const std::vector<double>& costs, const Vector& lengths,
                          const Communicator& communicator);

// Collective. The same points, each on the rank that is named for it, and ordered on each rank along a space-filling
// curve, so that a family lies close together in memory. The order does not depend on where they were.
PointCloud moved(const PointCloud& cloud, const std::vector<int>& ranks, const Communicator& communicator);

// Collective. Both.
PointCloud partitioned(const PointCloud& cloud, const Communicator& communicator, const Cuts& cuts = {});

// The points order[0], order[1], … of `cloud`.
PointCloud reordered(const PointCloud& cloud, const std::vector<int>& order);

}  // namespace strut
