#include "topology/neighbors/order.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace strut {

namespace {

// Points by blocks; then those on lattices, by their cells.
std::vector<int> by_blocks(const Stencils& stencils, const std::vector<int>& blocks) {
  std::vector<int> points(blocks.size());
  std::iota(points.begin(), points.end(), 0);
  const auto place = [&](int i) {
    const int lattice = stencils.of[i];
    return std::pair(lattice, lattice < 0 ? blocks[i] : stencils.lattices[lattice].cell(i));
  };
  std::stable_sort(points.begin(), points.end(), [&](int a, int b) { return place(a) < place(b); });
  return points;
}

}  // namespace

Order order_of(const Stencils& stencils, const Search& search, const CandidatePool& pool,
               const std::vector<int>& blocks) {
  Order order;
  const int owned = static_cast<int>(blocks.size());
  std::vector<char> needs_ghost(owned, 0), used(pool.ids.size(), 0);
  Eigen::AlignedBox3d others;
  for (std::size_t j = owned; j < pool.ids.size(); ++j) others.extend(pool.positions[j]);
  for (int i = 0; i < owned; ++i) {
    if (stencils.of[i] >= 0 && stencils.is_listed(i)) order.listed += stencils.lattices[stencils.of[i]].family_size(i);
    if (stencils.of[i] >= 0 && !(others.squaredExteriorDistance(pool.positions[i]) <= search.reach * search.reach))
      continue;
    for_each_neighbor(stencils, search, pool, i, [&](int j) {
      order.listed += stencils.of[i] < 0;
      if (j >= owned) needs_ghost[i] = used[j] = 1;
    });
  }
  order.points = by_blocks(stencils, blocks);
  const auto boundary =
      std::stable_partition(order.points.begin(), order.points.end(), [&](int i) { return !needs_ghost[i]; });
  order.interior = static_cast<int>(boundary - order.points.begin());
  for (int j = owned; j < static_cast<int>(pool.ids.size()); ++j) {
    if (used[j]) order.ghosts.push_back(j);
  }
  std::sort(order.ghosts.begin(), order.ghosts.end(), [&](int a, int b) { return pool.ids[a] < pool.ids[b]; });
  return order;
}

ClusterLists lists_of(const Stencils& stencils, const Search& search, const CandidatePool& pool,
                      const std::vector<int>& blocks, const Order& order, const std::vector<int>& local) {
  ClusterLists lists;
  lists.reserve(order.listed);
  ClusterLists::Builder builder(lists, pool.ids.size());
  const auto family = [&](int i, const auto& visit) { for_each_neighbor(search, pool, i, visit); };
  const std::span<const int> points(order.points);
  for (const auto part : {points.first(order.interior), points.subspan(order.interior)}) {
    for (auto begin = part.begin(); begin != part.end();) {
      const int kind = blocks[*begin];
      const bool is_listed = stencils.is_listed(*begin);
      const auto end = std::find_if(begin, part.end(),
                                    [&](int i) { return blocks[i] != kind || stencils.is_listed(i) != is_listed; });
      if (is_listed) builder.add_all({begin, end}, family, [&](int j) { return pool.ids[j]; });
      begin = end;
    }
  }
  lists.renumber(local);
  return lists;
}

}  // namespace strut
