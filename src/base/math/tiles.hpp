// Records of numbers in tiles: a tile stores as many records as a register has lanes, number by number, so that a
// kernel processes its records side by side and loads the n-th number of all of them at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/math/lanes.hpp"

namespace strut::small {

// One number of all records of a tile.
struct alignas(Lanes) TileRow {
  double lane[lane_count];
};

class Tiles {
 public:
  static constexpr std::size_t width = lane_count;

  // Makes `records` records, all equal to `numbers`.
  void assign(std::size_t records, std::span<const double> numbers) {
    records_ = records, numbers_ = numbers.size();
    rows_.resize((records + width - 1) / width * numbers_);
    for (std::size_t r = 0; r < rows_.size(); ++r) std::fill_n(rows_[r].lane, width, numbers[r % numbers_]);
  }

  std::size_t size() const { return records_; }
  double& at(std::size_t record, std::size_t number) { return tile_of(record)[number].lane[record % width]; }
  double at(std::size_t record, std::size_t number) const { return tile_of(record)[number].lane[record % width]; }
  // The tile of a record, from its first number on.
  TileRow* tile_of(std::size_t record) { return rows_.data() + record / width * numbers_; }
  const TileRow* tile_of(std::size_t record) const { return rows_.data() + record / width * numbers_; }
  double bytes() const { return static_cast<double>(rows_.size() * sizeof(TileRow)); }

 private:
  std::size_t records_ = 0, numbers_ = 0;
  std::vector<TileRow> rows_;
};

inline Eigen::Map<const Lanes, Eigen::AlignedMax> lanes(const TileRow& row) {
  return Eigen::Map<const Lanes, Eigen::AlignedMax>(row.lane);
}
inline Eigen::Map<Lanes, Eigen::AlignedMax> lanes(TileRow& row) {
  return Eigen::Map<Lanes, Eigen::AlignedMax>(row.lane);
}

}  // namespace strut::small
