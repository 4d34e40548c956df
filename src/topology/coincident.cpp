#include "topology/coincident.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"

namespace strut {

namespace {

// A point, as it is sent to other ranks.
struct Record {
  double x[3];
  double edge;  // of a cube of its volume, m
  std::int64_t id, number;
  int block;
};

// Unbounded cubic cells, identified by hashes that are almost unique. A cell has its points and those so near to it
// that one of its points might coincide with them.
class Cells {
 public:
  explicit Cells(double edge) : width_(0.5 * edge), longest_(4 * edge) {}

  // visit(cell, whether the cell contains the point)
  template <class Visit>
  void visit_cells(const Record& point, const Visit& visit) const {
    const double reach = at_one_place * std::min(point.edge, longest_);
    std::int64_t low[3], high[3], own[3];
    for (int c = 0; c < 3; ++c) {
      low[c] = cell_of(point.x[c] - reach), high[c] = cell_of(point.x[c] + reach), own[c] = cell_of(point.x[c]);
    }
    for (std::int64_t k = low[2]; k <= high[2]; ++k) {
      for (std::int64_t j = low[1]; j <= high[1]; ++j) {
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
          visit(number(i, j, k), i == own[0] && j == own[1] && k == own[2]);
        }
      }
    }
  }

  bool at_one(const Record& a, const Record& b) const {
    const double limit = at_one_place * std::min({a.edge, b.edge, longest_});
    const Vector apart(a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]);
    return apart.squaredNorm() < limit * limit;
  }

 private:
  std::int64_t cell_of(double x) const { return static_cast<std::int64_t>(std::floor(x / width_)); }
  static std::uint64_t number(std::int64_t i, std::int64_t j, std::int64_t k) {
    std::uint64_t mixed = 0;
    for (const std::int64_t one : {i, j, k}) {
      mixed = (mixed ^ static_cast<std::uint64_t>(one)) * 0x9e3779b97f4a7c15u;
      mixed ^= mixed >> 29;
    }
    return mixed;
  }

  double width_, longest_;
};

std::vector<Record> records_of(const PointCloud& cloud) {
  std::vector<Record> records;
  records.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector& X = cloud.positions[i];
    records.push_back(
        {{X[0], X[1], X[2]}, std::cbrt(cloud.volumes[i]), cloud.ids[i], cloud.element_ids[i], cloud.blocks[i]});
  }
  return records;
}

// Collective. Sends the points of each cell to the rank that owns the cell.
std::vector<Record> sent_to_owners(const std::vector<Record>& records, const Cells& cells,
                                   const Communicator& communicator) {
  const auto ranks = static_cast<std::uint64_t>(communicator.size());
  std::vector<int> to;
  std::vector<std::size_t> leaving;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto before = std::ssize(to);
    cells.visit_cells(records[i], [&](std::uint64_t cell, bool) {
      const int rank = static_cast<int>(cell % ranks);
      if (std::find(to.begin() + before, to.end(), rank) != to.end()) return;
      to.push_back(rank), leaving.push_back(i);
    });
  }
  return Routes(communicator, to).there([&](int k) { return records[leaving[k]]; });
}

struct Entry {
  std::uint64_t cell;
  std::size_t point;
  bool at_home;
};

struct Pair {
  Record first, second;  // by their ids
};

struct Found {
  std::int64_t points = 0;  // number of points that coincide with one of a smaller id
  std::optional<Pair> pair;
};

void look_through(std::span<const Entry> cell, const std::vector<Record>& points, const Cells& cells,
                  const std::function<bool(int, int)>& allowed, Found& found) {
  for (const Entry& one : cell) {
    const Record& b = points[one.point];
    if (!one.at_home) continue;
    for (const Entry& other : cell) {
      const Record& a = points[other.point];
      if (!(a.id < b.id) || !cells.at_one(a, b) || allowed(a.block, b.block)) continue;
      ++found.points;
      if (!found.pair || b.id < found.pair->second.id) found.pair = Pair{a, b};
      break;  // if all points coincide there is no need to test all pairs
    }
  }
}

Found found_on_this_rank(const std::vector<Record>& points, const Cells& cells, const Communicator& communicator,
                         const std::function<bool(int, int)>& allowed) {
  const auto ranks = static_cast<std::uint64_t>(communicator.size()),
             rank = static_cast<std::uint64_t>(communicator.rank());
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cells.visit_cells(points[i], [&](std::uint64_t cell, bool at_home) {
      if (cell % ranks == rank) entries.push_back({cell, i, at_home});
    });
  }
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    return a.cell != b.cell ? a.cell < b.cell : points[a.point].id < points[b.point].id;
  });
  Found found;
  for (auto begin = entries.begin(); begin != entries.end();) {
    const auto end = std::find_if(begin, entries.end(), [&](const Entry& one) { return one.cell != begin->cell; });
    look_through({begin, end}, points, cells, allowed, found);
    begin = end;
  }
  return found;
}

std::string describe(const PointCloud& cloud, const Pair& pair, std::int64_t count) {
  const auto name = [&](const Record& one) {
    return text_of(word(cloud.at), " ", one.number, " of block '", cloud.block_names[one.block], "'");
  };
  const auto& [a, b] = pair;
  const double apart = Vector(a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]).norm();
  const std::string others = count > 1 ? text_of(", and so on: ", count, " points are where others are") : "";
  return text_of(name(b), " is where ", name(a), " is, at (", a.x[0], ", ", a.x[1], ", ", a.x[2], ") m (", apart,
                 " m apart; the edge of a cube of its volume is ", b.edge, " m)", others, "; expected each once",
                 apart > 0 ? ", or elements that are less flat" : "");
}

}  // namespace

std::string coincident_points(const PointCloud& cloud, const Communicator& communicator,
                              const std::function<bool(int, int)>& allowed) {
  std::vector<Record> points = records_of(cloud);
  double logarithms = 0;  // so that a few points as large as the whole body do not put all others into one cell
  for (const Record& one : points) logarithms += std::log(one.edge);
  const auto all = communicator.sum(static_cast<std::int64_t>(points.size()));
  const Cells cells(std::exp(communicator.sum(logarithms) / static_cast<double>(std::max<std::int64_t>(1, all))));
  if (communicator.size() > 1) points = sent_to_owners(points, cells, communicator);
  const Found found = found_on_this_rank(points, cells, communicator, allowed);
  const std::int64_t count = communicator.sum(found.points);
  if (count == 0) return "";
  const std::vector<Pair> mine(found.pair ? 1 : 0, found.pair.value_or(Pair()));
  const std::vector<Pair> pairs = gather(communicator, std::span(mine));
  const auto first = std::min_element(pairs.begin(), pairs.end(),
                                      [](const Pair& a, const Pair& b) { return a.second.id < b.second.id; });
  std::string text = first == pairs.end() ? "" : describe(cloud, *first, count);
  communicator.broadcast(text);
  return text;
}

}  // namespace strut
