// Visibility: points within each other's horizon that are not bonded, because no material connects
// them.
#pragma once

#include <algorithm>
#include <vector>

#include "topology/neighbors/candidates.hpp"

namespace strut {

// The points within the horizon of each owned point to which it is not bonded. Empty if no block asks for it.
struct LeftOut {
  std::vector<std::size_t> start;
  std::vector<int> members;  // ascending for each point

  bool contains(int i, int j) const {
    if (start.empty()) return false;
    return std::binary_search(members.begin() + start[i], members.begin() + start[i + 1], j);
  }
};

// Collective.
LeftOut left_out(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Mirrored& mirrored,
                 const std::vector<Offered>& offers, const CandidatePool& pool, const CellGrid& grid, double reach,
                 const Communicator& communicator);

}  // namespace strut
