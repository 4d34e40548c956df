#include "checkpoint/moved_snapshot.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "base/parallel/gather_scatter.hpp"

namespace strut {

namespace {

// The places of some points among those that have come, by their ids.
std::vector<std::size_t> places_of(const std::vector<std::int64_t>& ids, const std::vector<std::int64_t>& arrived,
                                   const std::string& group) {
  std::vector<std::size_t> order(arrived.size()), places;
  std::iota(order.begin(), order.end(), 0);
  const auto id_of = [&](std::size_t k) { return arrived[k]; };
  std::ranges::sort(order, {}, id_of);
  for (const std::int64_t id : ids) {
    const auto place = std::ranges::lower_bound(order, id, {}, id_of);
    if (place == order.end() || arrived[*place] != id) throw std::logic_error("a point has not come: " + group);
    places.push_back(*place);
  }
  return places;
}

// Sends a number of each point at a time, so that messages need little memory beside the run's.
void move_group(const Snapshot::Group& from, const RanksOfPoints& ranks, Snapshot::Group& to,
                const Communicator& communicator) {
  std::vector<int> targets;
  for (const std::int64_t id : from.ids) targets.push_back(std::ranges::lower_bound(ranks, std::pair(id, -1))->second);
  const Routes routes(communicator, targets);
  const std::vector<std::size_t> places = places_of(to.ids, routes.there(from.ids), to.name);
  for (std::size_t column = 0; column < to.columns.size(); ++column) {
    const std::vector<double>& values = from.columns[column].values;
    const std::size_t width = to.columns[column].width;
    for (std::size_t c = 0; c < width; ++c) {
      const std::vector<double> arrived = routes.there([&](int k) { return values[k * width + c]; });
      for (std::size_t k = 0; k < places.size(); ++k) to.columns[column].values[k * width + c] = arrived[places[k]];
    }
  }
}

}  // namespace

void move_snapshot(const Snapshot& from, const RanksOfPoints& ranks, Snapshot& to, const Communicator& communicator) {
  to.numbers = from.numbers;
  to.rank_sums = from.rank_sums;
  const auto same = [](const Snapshot::Column& one, const Snapshot::Column& other) {
    return one.name == other.name && one.width == other.width;
  };
  for (std::size_t g = 0; g < to.groups.size(); ++g) {
    if (from.groups.at(g).name != to.groups[g].name ||
        !std::ranges::equal(from.groups[g].columns, to.groups[g].columns, same)) {
      throw std::logic_error("another partition keeps other things of points: " + to.groups[g].name);
    }
    move_group(from.groups[g], ranks, to.groups[g], communicator);
  }
}

}  // namespace strut
