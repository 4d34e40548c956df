#include "topology/pieces.hpp"

#include <algorithm>
#include <span>

#include "base/parallel/gather_scatter.hpp"
#include "base/union_find.hpp"

namespace strut {

namespace {

UnionFind joined_on_this_rank(const Domain& domain, const std::function<bool(int, int)>& joins) {
  UnionFind sets(domain.sites.size());
  for (int i = 0; i < domain.owned; ++i) {
    domain.families.for_each(i, [&](int j) {
      if (sets.first(i) != sets.first(j) && joins(i, j)) sets.join(i, j);
    });
  }
  return sets;
}

}  // namespace

// Each rank joins the points that it has, and takes over the least id that its ghosts have, until nothing changes.
std::vector<std::int64_t> piece_ids(const Domain& domain, const std::function<bool(int, int)>& joins) {
  const int count = static_cast<int>(domain.sites.size());
  UnionFind sets = joined_on_this_rank(domain, joins);
  std::vector<std::int64_t> of_point(count), least(count, 0);  // least: of each set, at its first point
  for (int i = 0; i < count; ++i) of_point[i] = domain.id(i);
  for (bool changed = true; changed;) {
    for (int i = 0; i < count; ++i) least[sets.first(i)] = of_point[sets.first(i)];
    for (int i = 0; i < count; ++i) least[sets.first(i)] = std::min(least[sets.first(i)], of_point[i]);
    double any = 0;
    for (int i = 0; i < count; ++i) {
      any = std::max(any, of_point[i] != least[sets.first(i)] ? 1.0 : 0.0);
      of_point[i] = least[sets.first(i)];
    }
    changed = domain.communicator.max(any) > 0;
    domain.halo.exchange(of_point);
  }
  of_point.resize(domain.owned);
  return of_point;
}

std::vector<std::int64_t> piece_ids(const Domain& domain) {
  return piece_ids(domain, [](int, int) { return true; });
}

std::pair<std::vector<int>, int> numbered_pieces(const Domain& domain) {
  const std::vector<std::int64_t> ids = piece_ids(domain);
  std::vector<std::int64_t> first;
  for (int i = 0; i < domain.owned; ++i) {
    if (ids[i] == domain.id(i)) first.push_back(ids[i]);
  }
  first = gather(domain.communicator, std::span<const std::int64_t>(first));
  std::ranges::sort(first);
  domain.communicator.broadcast(first);
  std::vector<int> numbers;
  for (const std::int64_t id : ids) {
    numbers.push_back(static_cast<int>(std::ranges::lower_bound(first, id) - first.begin()));
  }
  return {std::move(numbers), static_cast<int>(first.size())};
}

}  // namespace strut
