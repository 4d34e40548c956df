#include "topology/neighbors/search.hpp"

#include <algorithm>

namespace strut {

std::vector<std::pair<int, std::int64_t>> separated_by_cracks(const Search& search, const CandidatePool& pool,
                                                              const std::vector<int>& order) {
  std::vector<std::pair<int, std::int64_t>> pairs;
  if (std::ranges::all_of(search.cracks, [](const std::vector<Crack>& of_body) { return of_body.empty(); }))
    return pairs;
  for (std::size_t local = 0; local < order.size(); ++local) {
    const int i = order[local];
    for_each_within(search.grid, pool, i, search.reach, [&](int j) {
      const Vector xi = pool.positions[j] - pool.positions[i];
      if (!bonded(pool.deltas[i], pool.deltas[j], xi) || search.left_out.contains(i, j)) return;
      if (search.is_cut(pool, i, j)) pairs.emplace_back(local, pool.ids[j]);
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace strut
