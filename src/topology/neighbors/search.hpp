// Families found by a search, for all points without a stencil.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "topology/neighbors/candidates.hpp"
#include "topology/neighbors/cracks.hpp"

namespace strut {

// Visibility: the points within the horizon of each owned point to which it is not bonded, because no material connects
// them. Empty if no block asks for it.
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

// Data for a search of families that are no stencils.
struct Search {
  const CellGrid& grid;
  const LeftOut& left_out;
  const std::vector<std::vector<Crack>>& cracks;  // by body
  double reach;

  bool is_cut(const CandidatePool& pool, int i, int j) const {
    const std::vector<Crack>& here = cracks[pool.bodies[i]];
    return std::any_of(here.begin(), here.end(),
                       [&](const Crack& crack) { return crosses(crack, pool.positions[i], pool.positions[j]); });
  }
};

// Calls visit(j) for the family of owned point i.
template <class Visit>
void for_each_neighbor(const Search& search, const CandidatePool& pool, int i, Visit&& visit) {
  for_each_within(search.grid, pool, i, search.reach, [&](int j) {
    if (!search.left_out.contains(i, j) && !search.is_cut(pool, i, j)) visit(j);
  });
}

// Pairs of an owned point, in the order given, and a point to which only a crack prevents a bond
// (Domain::separated).
std::vector<std::pair<int, std::int64_t>> separated_by_cracks(const Search& search, const CandidatePool& pool,
                                                              const std::vector<int>& order);

}  // namespace strut
