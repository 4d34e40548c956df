#include "checkpoint/moved_snapshot.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "topology/nearby_ranks.hpp"

namespace strut {

namespace {

// Width of a record for the points of a group: the id, then all columns.
int record_width(const Snapshot::Group& group) {
  int width = 1;
  for (const Snapshot::Column& column : group.columns) width += column.width;
  return width;
}

struct Outgoing {
  std::vector<int> ranks;
  std::vector<double> records;
};

Outgoing leaving(const Snapshot::Group& group, const RanksOfPoints& ranks) {
  Outgoing outgoing;
  for (const std::int64_t id : group.ids) {
    outgoing.ranks.push_back(std::lower_bound(ranks.begin(), ranks.end(), std::pair(id, -1))->second);
  }
  std::vector<std::size_t> order(group.ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return outgoing.ranks[k]; });
  outgoing.records.reserve(order.size() * record_width(group));
  for (const std::size_t k : order) {
    outgoing.records.push_back(static_cast<double>(group.ids[k]));
    for (const Snapshot::Column& column : group.columns) {
      const auto row = column.values.begin() + static_cast<std::ptrdiff_t>(k * column.width);
      outgoing.records.insert(outgoing.records.end(), row, row + column.width);
    }
  }
  std::ranges::sort(outgoing.ranks);
  return outgoing;
}

// The position of each received record, by id.
std::vector<std::pair<std::int64_t, std::size_t>> places_by_id(const std::vector<double>& records, int width) {
  std::vector<std::pair<std::int64_t, std::size_t>> places;
  for (std::size_t at = 0; at < records.size(); at += width) {
    places.emplace_back(static_cast<std::int64_t>(records[at]), at);
  }
  std::ranges::sort(places);
  return places;
}

void take(const std::vector<double>& records, Snapshot::Group& group) {
  const auto places = places_by_id(records, record_width(group));
  for (std::size_t k = 0; k < group.ids.size(); ++k) {
    const auto place = std::ranges::lower_bound(places, std::pair(group.ids[k], std::size_t{0}));
    if (place == places.end() || place->first != group.ids[k])
      throw std::logic_error("a point has not come: " + group.name);
    auto value = records.begin() + static_cast<std::ptrdiff_t>(place->second) + 1;
    for (Snapshot::Column& column : group.columns) {
      std::copy_n(value, column.width, column.values.begin() + static_cast<std::ptrdiff_t>(k * column.width));
      value += column.width;
    }
  }
}

}  // namespace

void move_snapshot(Snapshot from, const RanksOfPoints& ranks, Snapshot& to, const Communicator& communicator) {
  to.numbers = from.numbers;
  to.shares = from.shares;
  for (std::size_t g = 0; g < to.groups.size(); ++g) {
    const int width = record_width(to.groups[g]);
    if (from.groups.at(g).name != to.groups[g].name || record_width(from.groups[g]) != width) {
      throw std::logic_error("another partition keeps other things of points: " + to.groups[g].name);
    }
    const Outgoing outgoing = leaving(from.groups[g], ranks);
    from.groups[g] = {};  // frees memory: the points are the largest part of a run, and three copies of them exist here
    take(sent_to_ranks(outgoing.ranks, outgoing.records, width, communicator), to.groups[g]);
  }
}

}  // namespace strut
