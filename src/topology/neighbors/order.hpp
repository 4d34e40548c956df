// The order of points in memory, and their neighbor lists.
#pragma once

#include <vector>

#include "topology/neighbors/families.hpp"
#include "topology/neighbors/stencils.hpp"

namespace strut {

// The order in which points and ghosts stand in memory, as places in the pool: owned points without ghosts in their
// family first, then the others, both by blocks and along the curve, or as they lie in their lattice; then the ghosts
// that are in some family, ordered by id (ranks that own them send runs of ids).
struct Order {
  std::vector<int> points, ghosts;
  std::size_t listed = 0;  // bonds of points that have lists
  int interior = 0;
};

Order order_of(const Stencils& stencils, const Search& search, const CandidatePool& pool,
               const std::vector<int>& blocks);

// Lists of the points that have them, in their order, neighbors by local[], from a second look at the grid. A cluster
// is of points that follow upon each other, of one block, and of the interior or the boundary.
ClusterLists lists_of(const Stencils& stencils, const Search& search, const CandidatePool& pool,
                      const std::vector<int>& blocks, const Order& order, const std::vector<int>& local);

}  // namespace strut
