#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "base/union_find.hpp"
#include "mesh/voxels.hpp"

namespace strut::mesh {

namespace {

constexpr double same = 1e-9;  // spacings: differences by round-off

void sort(std::vector<Level>& levels) {
  std::sort(levels.begin(), levels.end(),
            [](const Level& a, const Level& b) { return a.value != b.value ? a.value < b.value : a.voxel < b.voxel; });
}

// Adds voxels one by one, and tracks the pieces connected by faces and the size of the largest one.
class Pieces {
 public:
  Pieces(const VoxelGrid& grid, std::size_t most)
      : grid_(grid), place_(grid.count(), -1), sets_(most), size_(most, 1) {}

  void add(int voxel) {
    const int place = place_[voxel] = added_++;
    ++pieces_;
    const Eigen::Array3i cell = grid_.cell(voxel);
    const std::array<int, 3> stride = {1, grid_.cells[0], grid_.cells[0] * grid_.cells[1]};
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] > 0) join(place, place_[voxel - stride[axis]]);
      if (cell[axis] < grid_.cells[axis] - 1) join(place, place_[voxel + stride[axis]]);
      const int around = (grid_.cells[axis] - 1) * stride[axis];
      if (grid_.periodic[axis] && cell[axis] == 0) join(place, place_[voxel + around]);
      if (grid_.periodic[axis] && cell[axis] == grid_.cells[axis] - 1) join(place, place_[voxel - around]);
    }
  }

  std::size_t pieces() const { return pieces_; }
  std::size_t largest() const { return added_ == 0 ? 0 : size_[largest_]; }
  bool in_largest(int voxel) { return sets_.first(place_[voxel]) == sets_.first(largest_); }

 private:
  void join(int place, int other) {
    if (other < 0 || sets_.first(place) == sets_.first(other)) return;
    const int both = size_[sets_.first(place)] + size_[sets_.first(other)];
    sets_.join(place, other);
    size_[sets_.first(place)] = both;
    --pieces_;
    if (both > size_[largest_]) largest_ = sets_.first(place);
  }

  const VoxelGrid& grid_;
  std::vector<int> place_;  // index of a voxel in the order of adding; -1: not yet
  UnionFind sets_;
  std::vector<int> size_;  // by index; valid for the first of a set
  int added_ = 0, largest_ = 0;
  std::size_t pieces_ = 0;
};

// The largest piece of the first n voxels.
void take(const std::vector<Level>& levels, std::size_t n, Pieces& pieces, Struts& struts) {
  for (std::size_t c = 0; c < n; ++c) {
    if (pieces.in_largest(levels[c].voxel)) struts.voxels.push_back(levels[c].voxel);
  }
  std::sort(struts.voxels.begin(), struts.voxels.end());
  struts.dropped_pieces = pieces.pieces() - 1;
  struts.dropped_voxels = n - struts.voxels.size();
}

// Voxels at the last level come together; they are filled in part, so that the piece has exactly the wanted volume.
void fill_last(const std::vector<Level>& levels, std::size_t first, std::size_t n, std::size_t wanted, Pieces& pieces,
               Struts& struts) {
  std::vector<int> last;
  for (std::size_t c = first; c < n; ++c) {
    if (pieces.in_largest(levels[c].voxel)) last.push_back(levels[c].voxel);
  }
  const std::size_t excess = struts.voxels.size() - std::min(wanted, struts.voxels.size());
  if (excess == 0 || excess >= last.size()) return;  // pieces that connected late
  struts.fills.assign(struts.voxels.size(), 1);
  for (const int voxel : last) {
    const auto place = std::lower_bound(struts.voxels.begin(), struts.voxels.end(), voxel);
    struts.fills[place - struts.voxels.begin()] = 1 - static_cast<double>(excess) / static_cast<double>(last.size());
  }
}

// Returns false if there are not enough voxels.
bool grow(const std::vector<Level>& levels, const VoxelGrid& grid, std::size_t wanted, double scale, Struts& struts) {
  Pieces pieces(grid, levels.size());
  const double tolerance = same * scale;
  std::size_t n = 0, first = 0;
  while (n < levels.size() && pieces.largest() < wanted) {
    if (n > 0 && levels[n].value - levels[n - 1].value > tolerance) first = n;
    pieces.add(levels[n++].voxel);
  }
  while (n < levels.size() && levels[n].value - levels[n - 1].value <= tolerance) pieces.add(levels[n++].voxel);
  if (n == levels.size()) return false;  // the next one could have the same level
  struts.radius = (levels[n - 1].value + levels[n].value) / 2;
  take(levels, n, pieces, struts);
  fill_last(levels, first, n, wanted, pieces, struts);
  return true;
}

}  // namespace

Struts largest_piece(std::vector<Level> levels, const VoxelGrid& grid, std::size_t wanted, double scale) {
  sort(levels);
  Struts struts;
  if (!grow(levels, grid, std::max<std::size_t>(wanted, 1), scale, struts)) {
    throw Error("the box has fewer voxels than the relative density asks for");
  }
  return struts;
}

Struts largest_piece_below(std::vector<Level> levels, const VoxelGrid& grid, double most) {
  sort(levels);
  Pieces pieces(grid, levels.size());
  std::size_t n = 0;
  while (n < levels.size() && levels[n].value <= most) pieces.add(levels[n++].voxel);
  if (n == 0) throw Error("members of this thickness hold no voxel: the spacing is too large");
  Struts struts{.radius = most};
  take(levels, n, pieces, struts);
  return struts;
}

Struts struts_around(const std::vector<Edge>& edges, const VoxelGrid& grid, std::size_t wanted,
                     const StrutShape& shape) {
  double length = 0;
  for (const Edge& edge : edges) length += length_within(edge, grid.size);
  if (!(length > 0)) throw Error("no edge of the foam's cells meets the box: it is too small for this cell");
  wanted = std::max<std::size_t>(wanted, 1);
  // Separate cylinders with the wanted volume; because they overlap at the vertices, they must be thicker.
  const double volume = static_cast<double>(wanted) * grid.spacing().prod();
  double reach = 1.2 * std::sqrt(volume / (std::numbers::pi * length)) + grid.spacing().maxCoeff();
  Struts struts;
  for (;;) {
    std::vector<Level> levels = strut_levels(edges, shape, grid, reach);
    sort(levels);
    if (grow(levels, grid, wanted, grid.spacing().minCoeff(), struts)) return struts;
    if (reach > 2 * grid.size.norm()) throw Error("the box has fewer voxels than the relative density asks for");
    reach *= 1.4;
  }
}

}  // namespace strut::mesh
