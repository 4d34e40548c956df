#include "setup/found_points.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "base/parallel/gather_scatter.hpp"

namespace strut {

std::vector<FoundPoints> found_points(const Body& body, const std::vector<std::vector<int>>& lists) {
  const Communicator& ranks = body.domain.communicator;
  std::vector<double> counts, least;  // least: minus the least id
  std::vector<int> ones;
  for (const std::vector<int>& points : lists) {
    counts.push_back(static_cast<double>(points.size()));
    least.push_back(std::numeric_limits<double>::lowest());
    ones.push_back(-1);
    for (const int i : points) {
      const double id = -static_cast<double>(body.domain.cloud.ids[i]);
      if (id > least.back()) least.back() = id, ones.back() = i;
    }
  }
  const std::vector<double> own = least;
  ranks.sum(counts), ranks.max(least);
  std::vector<double> places(6 * lists.size(), 0);
  for (std::size_t n = 0; n < lists.size(); ++n) {
    if (ones[n] < 0 || own[n] != least[n]) continue;
    for (int c = 0; c < 3; ++c) {
      places[6 * n + c] = body.domain.reference(ones[n])[c];
      places[6 * n + 3 + c] = body.displacement(ones[n])[c];
    }
  }
  ranks.sum(places);
  std::vector<FoundPoints> found;
  for (std::size_t n = 0; n < lists.size(); ++n) {
    const double* of_one = &places[6 * n];
    found.push_back(
        {static_cast<std::int64_t>(counts[n]), {of_one[0], of_one[1], of_one[2]}, {of_one[3], of_one[4], of_one[5]}});
  }
  return found;
}

std::vector<IndexPair> on_all_ranks(std::vector<IndexPair> pairs, const Communicator& communicator) {
  pairs = gather(communicator, std::span<const IndexPair>(pairs));
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  communicator.broadcast(pairs);
  return pairs;
}

std::map<IndexPair, FoundPoints> found_points_of_pairs(const Body& body,
                                                       const std::map<IndexPair, std::vector<int>>& lists) {
  std::vector<IndexPair> pairs;
  for (const auto& [pair, points] : lists) pairs.push_back(pair);
  pairs = on_all_ranks(std::move(pairs), body.domain.communicator);
  std::vector<std::vector<int>> by_pair;
  for (const IndexPair& pair : pairs) by_pair.push_back(lists.contains(pair) ? lists.at(pair) : std::vector<int>());
  const std::vector<FoundPoints> found = found_points(body, by_pair);
  std::map<IndexPair, FoundPoints> all;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    if (found[n].count > 0) all[pairs[n]] = found[n];
  }
  return all;
}

}  // namespace strut
