// Families found by a search, for all points without a stencil.
#pragma once

#include <utility>
#include <vector>

#include "topology/neighbors/cracks.hpp"
#include "topology/neighbors/left_out.hpp"

namespace strut {

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
