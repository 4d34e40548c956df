#include "topology/neighbors/visibility.hpp"

#include <algorithm>

#include "topology/neighbors/block_bonds.hpp"

namespace strut {

namespace {

using SharedNode = std::pair<std::int64_t, int>;

// Shared nodes renumbered from 0: the points of each shared node, or the shared nodes of each point.
struct Table {
  std::vector<std::size_t> start{0};
  std::vector<int> entries;
};

Table points_of_nodes(const std::vector<SharedNode>& shared_nodes) {
  Table table;
  for (std::size_t k = 0; k < shared_nodes.size(); ++k) {
    if (k > 0 && shared_nodes[k].first != shared_nodes[k - 1].first) table.start.push_back(k);
    table.entries.push_back(shared_nodes[k].second);
  }
  table.start.push_back(shared_nodes.size());
  return table;
}

Table turned(const Table& points_of, std::size_t points) {
  Table table;
  table.start.assign(points + 1, 0);
  for (const int point : points_of.entries) ++table.start[point + 1];
  for (std::size_t i = 0; i < points; ++i) table.start[i + 1] += table.start[i];
  table.entries.resize(points_of.entries.size());
  std::vector<std::size_t> next(table.start.begin(), table.start.end() - 1);
  for (std::size_t shared_node = 0; shared_node + 1 < points_of.start.size(); ++shared_node) {
    for (std::size_t k = points_of.start[shared_node]; k < points_of.start[shared_node + 1]; ++k) {
      table.entries[next[points_of.entries[k]]++] = static_cast<int>(shared_node);
    }
  }
  return table;
}

std::span<const int> row(const Table& table, std::size_t i) {
  return {table.entries.data() + table.start[i], table.entries.data() + table.start[i + 1]};
}

}  // namespace

Visibility::Visibility(const MeshedPoints& points, std::vector<SharedNode> shared_nodes)
    : points_(points),
      mark_(points.positions.size(), 0),
      seen_(points.positions.size(), 0),
      before_(points.positions.size(), -1) {
  std::sort(shared_nodes.begin(), shared_nodes.end());
  const Table points_of = points_of_nodes(shared_nodes);
  const Table nodes_of = turned(points_of, points.positions.size());
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    std::vector<int>& near = front_;
    near.clear();
    for (const int shared_node : row(nodes_of, i)) {
      for (const int j : row(points_of, shared_node)) {
        if (j != static_cast<int>(i) && points.bodies[j] == points.bodies[i]) near.push_back(j);
      }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    touching_.insert(touching_.end(), near.begin(), near.end());
    start_.push_back(touching_.size());
  }
}

bool Visibility::touch(int i, int j) const {
  const std::span<const int> near = touching(i);
  return std::binary_search(near.begin(), near.end(), j);
}

bool Visibility::near(int i, int j) const {
  return bonded(points_.horizons[i], points_.horizons[j], points_.positions[j] - points_.positions[i]);
}

// In a solid body the paths of spread() reach all points; walk and flood are for those separated or around a corner.
std::vector<int> Visibility::apart(int i, std::span<const int> family, std::span<const int> asked) {
  ++now_;
  for (const int j : family) mark_[j] = 2 * now_;
  spread(i, family.size());
  std::vector<int> found;
  for (const int j : asked) {
    if (is_missing(j) && !walks_straight(i, j) && !floods(i, j)) found.push_back(j);
  }
  return found;
}

// Extends paths from i by one point each. It keeps one of many paths to a point, so that it misses some points.
void Visibility::spread(int i, std::size_t family) {
  front_.clear();
  const auto join = [this](int j, int before) {
    ++mark_[j];
    before_[j] = before;
    front_.push_back(j);
  };
  for (const int k : touching(i)) {
    if (in_family(k)) join(k, -1);
  }
  for (std::size_t n = 0; n < front_.size() && front_.size() < family; ++n) {
    const int k = front_[n];
    for (const int j : touching(k)) {
      if (is_missing(j) && is_near_path(j, k)) join(j, k);
    }
  }
}

bool Visibility::is_near_path(int j, int end) const {
  for (int k = end; k >= 0; k = before_[k]) {
    if (!near(j, k)) return false;
  }
  return true;
}

// Walks from i to the touching point nearest to j, as long as the distance decreases.
bool Visibility::walks_straight(int i, int j) const {
  const auto distance = [&](int k) { return (points_.positions[j] - points_.positions[k]).squaredNorm(); };
  double left = distance(i);
  for (int at = i; !touch(at, j);) {
    int next = -1;
    for (const int k : touching(at)) {
      if (!in_family(k)) continue;
      const double nearer = distance(k);
      if (nearer < left && near(j, k)) next = k, left = nearer;
    }
    if (next < 0) return false;
    at = next;
  }
  return true;
}

bool Visibility::floods(int i, int j) {
  ++flood_;
  front_.assign(1, i);
  while (!front_.empty()) {
    const int at = front_.back();
    front_.pop_back();
    for (const int k : touching(at)) {
      if (k == j) return true;
      if (seen_[k] == flood_ || !in_family(k)) continue;
      seen_[k] = flood_;
      if (near(j, k)) front_.push_back(k);
    }
  }
  return false;
}

}  // namespace strut
