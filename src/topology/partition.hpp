// The partition of points over the ranks, and their order in memory.
#pragma once

#include "topology/cloud.hpp"

namespace strut {

class Communicator;

struct PartitionWeights {
  std::vector<double> costs;        // of a point of each block, in any unit: ranks get equal sums (empty: equal costs)
  Vector lengths = Vector::Ones();  // weight of a length along each axis: cuts are across the longest
};

// Collective. The rank for each point, by recursive coordinate bisection (Zoltan's RCB). `costs`: of each point, in any
// unit.
std::vector<int> bisected(const PointCloud& cloud, const std::vector<double>& costs, const Vector& lengths,
                          const Communicator& communicator);

// Collective. Moves each point to the rank given for it, and orders the points of each rank along a space-filling
// curve, so that a family is close together in memory. The order does not depend on the ranks that they came from.
PointCloud moved(const PointCloud& cloud, const std::vector<int>& ranks, const Communicator& communicator);

// Collective. Bisects and moves.
PointCloud partitioned(const PointCloud& cloud, const Communicator& communicator, const PartitionWeights& weights = {});

// The points order[0], order[1], … of `cloud`.
PointCloud reordered(const PointCloud& cloud, const std::vector<int>& order);

}  // namespace strut
