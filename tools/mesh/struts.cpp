#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/errors.hpp"
#include "base/union_find.hpp"
#include "mesh/voxels.hpp"

namespace strut::mesh {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double same = 1e-9;  // spacings: differences by round-off

struct Candidate {
  double distance;  // m, from the center to the nearest edge
  int voxel;
};

double squared_distance(const Edge& edge, const Vector& along, double inverse_square, const Vector& x) {
  const Vector from = x - edge.a;
  const double t = std::clamp(from.dot(along) * inverse_square, 0.0, 1.0);
  return (from - t * along).squaredNorm();
}

// Lowers the distances of the voxels in the box around an edge and its `reach`. Edges are short compared with the grid,
// so that each meets few voxels, and each voxel the few edges near it.
void lower_distances(const Edge& edge, const VoxelGrid& grid, double reach, std::vector<double>& squared) {
  const Vector h = grid.spacing();
  const Vector along = edge.b - edge.a;
  const double inverse_square = along.squaredNorm() > 0 ? 1 / along.squaredNorm() : 0;
  // In cells, clamped before conversion to integers.
  const auto cells = [&](const Eigen::Array3d& x) {
    return (x / h.array()).floor().max(-1).min(grid.cells.cast<double>()).cast<int>().eval();
  };
  const Eigen::Array3i low = cells(edge.a.cwiseMin(edge.b).array() - reach).max(0);
  const Eigen::Array3i high = cells(edge.a.cwiseMax(edge.b).array() + reach).min(grid.cells - 1);
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const Vector center((i + 0.5) * h[0], (j + 0.5) * h[1], (k + 0.5) * h[2]);
        double& least = squared[grid.index(i, j, k)];
        least = std::min(least, squared_distance(edge, along, inverse_square, center));
      }
    }
  }
}

// All voxels within `reach` of an edge, sorted by distance.
std::vector<Candidate> candidates_within(double reach, const std::vector<Edge>& edges, const VoxelGrid& grid) {
  std::vector<double> squared(grid.count(), infinity);
  for (const Edge& edge : edges) lower_distances(edge, grid, reach, squared);
  std::vector<Candidate> candidates;
  for (std::size_t n = 0; n < squared.size(); ++n) {
    if (squared[n] <= reach * reach) candidates.push_back({std::sqrt(squared[n]), static_cast<int>(n)});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.voxel < b.voxel;
  });
  return candidates;
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

// Returns false if there are not enough candidates.
bool grow(const std::vector<Candidate>& candidates, const VoxelGrid& grid, std::size_t wanted, Struts& struts) {
  Pieces pieces(grid, candidates.size());
  const double tolerance = same * grid.spacing().minCoeff();
  std::size_t n = 0;
  while (n < candidates.size() && pieces.largest() < wanted) pieces.add(candidates[n++].voxel);
  while (n < candidates.size() && candidates[n].distance - candidates[n - 1].distance <= tolerance) {
    pieces.add(candidates[n++].voxel);
  }
  if (n == candidates.size()) return false;  // the next one could have the same distance
  struts.radius = (candidates[n - 1].distance + candidates[n].distance) / 2;
  for (std::size_t c = 0; c < n; ++c) {
    if (pieces.in_largest(candidates[c].voxel)) struts.voxels.push_back(candidates[c].voxel);
  }
  std::sort(struts.voxels.begin(), struts.voxels.end());
  struts.dropped_pieces = pieces.pieces() - 1;
  struts.dropped_voxels = n - struts.voxels.size();
  return true;
}

}  // namespace

Struts struts_around(const std::vector<Edge>& edges, const VoxelGrid& grid, std::size_t wanted) {
  double length = 0;
  for (const Edge& edge : edges) length += length_within(edge, grid.size);
  if (!(length > 0)) throw Error("no edge of the foam's cells meets the box: it is too small for this cell");
  wanted = std::max<std::size_t>(wanted, 1);
  // Separate cylinders with the wanted volume; because they overlap at the vertices, they must be thicker.
  const double volume = static_cast<double>(wanted) * grid.spacing().prod();
  double reach = 1.2 * std::sqrt(volume / (std::numbers::pi * length)) + grid.spacing().maxCoeff();
  Struts struts;
  while (!grow(candidates_within(reach, edges, grid), grid, wanted, struts)) {
    if (reach > 2 * grid.size.norm()) throw Error("the box has fewer voxels than the relative density asks for");
    reach *= 1.4;
  }
  return struts;
}

}  // namespace strut::mesh
