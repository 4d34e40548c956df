// Who owns which point: geometric partition and the order of points in memory.
#pragma once

#include "points/cloud.hpp"

namespace strut {

class Communicator;

// Collective. The same points, spread over the ranks by recursive coordinate bisection (Zoltan's RCB) and ordered on
// each rank along a space-filling curve, so that a family lies close together in memory. `costs`: of a point of each
// block, in any unit: ranks get equal sums of it (empty: all alike).
PointCloud partitioned(const PointCloud& cloud, const Communicator& communicator,
                       const std::vector<double>& costs = {});

// The points order[0], order[1], … of `cloud`.
PointCloud reordered(const PointCloud& cloud, const std::vector<int>& order);

}  // namespace strut
