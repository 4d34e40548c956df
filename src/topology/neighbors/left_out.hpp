// Bonds through material: which points within each other's horizon are not bonded, for no material leads from one to
// the other.
#pragma once

#include <algorithm>
#include <vector>

#include "topology/neighbors/candidates.hpp"

namespace strut {

// Whom an owned point is not bonded to although it is within the horizon. Empty where no block asks for it.
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
