// SIMD: the records of a group that are stored in tiles, as kernels take them.
#pragma once

#include <array>

#include "base/math/tiles.hpp"
#include "mechanics/kernels/lane_groups.hpp"

namespace strut {

using small::TileRow;

// Gives the tile of a group's records if they fill it in the order of the lanes, else a copy, because the other records
// of a tile belong to another group, which another thread may write. Row: const if the records are only read.
template <std::size_t numbers, class Row = TileRow>
class GroupTile {
 public:
  using Places = std::array<int, LaneGroup::width>;

  template <class Tiles>
  GroupTile(Tiles& all, const Places& places, int count) {
    bool own = count == LaneGroup::width && places[0] % LaneGroup::width == 0;
    for (int l = 1; l < count; ++l) own = own && places[l] == places[0] + l;
    rows_ = own ? all.tile_of(places[0]) : copy_.data();
    if (own) return;
    std::array<const TileRow*, LaneGroup::width> tile;
    for (int l = 0; l < LaneGroup::width; ++l) tile[l] = all.tile_of(places[l]);
    for (std::size_t n = 0; n < numbers; ++n) {
      small::lanes(copy_[n]) = small::lanes_of([&](int l) { return tile[l][n].lane[places[l] % LaneGroup::width]; });
    }
  }
  GroupTile(const GroupTile&) = delete;

  Row* rows() const { return rows_; }
  Row& operator[](std::size_t n) const { return rows_[n]; }
  // Writes back what has changed in a copy.
  void give_back(small::Tiles& all, const Places& places, int count) const {
    if (rows_ != copy_.data()) return;
    for (int l = 0; l < count; ++l) {
      TileRow* tile = all.tile_of(places[l]);
      for (std::size_t n = 0; n < numbers; ++n) {
        if (double& kept = tile[n].lane[places[l] % LaneGroup::width]; kept != rows_[n].lane[l]) {
          kept = rows_[n].lane[l];
        }
      }
    }
  }

 private:
  Row* rows_;
  std::array<TileRow, numbers> copy_;
};

}  // namespace strut
