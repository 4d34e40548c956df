// The order of points in memory, and their neighbor lists.
#pragma once

#include <vector>

#include "topology/neighbors/families.hpp"
#include "topology/neighbors/stencils.hpp"

namespace strut {

// The order of points and ghosts in memory, as indices in the pool: owned points without ghosts in their family, then
// the other owned points, both by blocks and along the curve or their lattice; then the ghosts that are in a family, by
// id (so that the ranks that own them send runs of ids).
struct Order {
  std::vector<int> points, ghosts;
  std::size_t listed = 0;  // number of bonds of points with lists
  int interior = 0;
};

Order order_of(const Stencils& stencils, const Search& search, const CandidatePool& pool,
               const std::vector<int>& blocks);

// The lists of the points that have them, in their order, with neighbors renumbered by local[], from a second pass over
// the grid. A cluster consists of consecutive points of one block, and of the interior or the boundary.
ClusterLists lists_of(const Stencils& stencils, const Search& search, const CandidatePool& pool,
                      const std::vector<int>& blocks, const Order& order, const std::vector<int>& local);

}  // namespace strut
