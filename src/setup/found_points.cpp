#include "setup/found_points.hpp"

#include <limits>

#include "base/text.hpp"

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

std::string place_text(const Vector& place) { return text_of("(", place[0], ", ", place[1], ", ", place[2], ") m"); }

}  // namespace strut
