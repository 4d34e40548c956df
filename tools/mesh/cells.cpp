#include "mesh/cells.hpp"

#include <set>
#include <utility>

#include "mesh/flat_cells.hpp"
#include "mesh/merging.hpp"
#include "mesh/pieces.hpp"

namespace strut::mesh {

namespace {

VoxelGrid coarse_grid(const VoxelGrid& fine, int factor) {
  const Eigen::Array3i cells = (fine.cells + factor - 1) / factor;
  return {fine.spacing().array() * factor * cells.cast<double>(), cells};
}

// Merges small pieces into their neighbors. A piece that cannot be merged waits until its neighbors have changed.
class SmallPieces {
 public:
  SmallPieces(const Material& material, const VoxelGrid& grid, double limit, Pieces& pieces)
      : list_(pieces.list), merging_(pieces, links_of(material, pieces), grid), limit_(limit) {}

  void merge(Cells& cells) {
    for (std::size_t p = 0; p < list_.size(); ++p) note(static_cast<int>(p));
    while (!small_.empty()) {
      const auto [filled, piece] = *small_.begin();
      small_.erase(small_.begin());
      if (!merging_.alive(piece) || list_[piece].filled != filled) continue;  // has been merged since
      merging_.links(piece).empty() ? drop(piece, cells) : merge(piece, cells);
    }
    for (std::size_t p = 0; p < list_.size(); ++p) cells.small += is_small(static_cast<int>(p)) ? 1 : 0;
    merging_.finish();
  }

 private:
  bool is_small(int piece) const { return merging_.alive(piece) && list_[piece].filled < limit_; }

  void note(int piece) {
    if (is_small(piece)) small_.emplace(list_[piece].filled, piece);
  }

  void drop(int piece, Cells& cells) {
    merging_.drop(piece);
    ++cells.dropped;
    cells.dropped_volume += list_[piece].part.volume;
  }

  void merge(int piece, Cells& cells) {
    const int into = merging_.merge(piece);
    if (into < 0) return;
    ++cells.merged;
    // Notes this piece, and those that may have waited for its change.
    note(into);
    for (const int other : merging_.links(into)) {
      note(other);
      for (const int further : merging_.links(other)) note(further);
    }
  }

  std::vector<Piece>& list_;
  Merging merging_;
  double limit_;
  std::set<std::pair<double, int>> small_;  // by size, pieces still to be processed
};

}  // namespace

double Cells::volume() const {
  double sum = 0;
  for (const io::PartialCell& part : parts) sum += part.volume;
  return sum;
}

Cells gathered(const std::vector<int>& voxels, const std::vector<double>& fills, const VoxelGrid& grid,
               const Gathering& gathering) {
  const int factor = gathering.factor;
  const Material material = material_of(voxels, fills, grid);
  Cells cells;
  cells.grid = coarse_grid(grid, factor);
  Pieces pieces = connected_within(material, cells.grid, factor);
  measure(material, cells.grid, factor, pieces);
  SmallPieces(material, cells.grid, gathering.smallest * factor * factor * factor, pieces).merge(cells);
  mend_flat_cells(material, gathering, pieces, cells);
  return cells;
}

}  // namespace strut::mesh
