#include "topology/neighbors/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "topology/bounding_box.hpp"
#include "topology/cloud.hpp"

namespace strut {

namespace {

constexpr double tolerance = 1e-9;  // of coordinates, in spacings

// Largest distance along an axis, in cells, within a family.
int cells_within(const LatticeFrame& frame, int axis) {
  return static_cast<int>(std::floor(frame.horizon * with_round_off / frame.spacing[axis]));
}

// ---- Detection of lattices -----------------------------------------------------------------------------------------

struct BodyPoints {
  std::vector<Vector> positions;
  double largest_horizon = 0, smallest_horizon = std::numeric_limits<double>::infinity();
  bool wants_lists = false, wants_stencil = false, loses_bonds = false;
};

BodyPoints points_of(const PointCloud& cloud, const std::vector<double>& horizons, const std::vector<BlockBonds>& bonds,
                     int body) {
  BodyPoints points;
  for (const BlockBonds& block : bonds) {
    points.wants_lists |= block.body == body && block.families == FamilyKind::lists;
    points.wants_stencil |= block.body == body && block.families == FamilyKind::stencil;
    points.loses_bonds |= block.body == body && block.may_lose_bonds;
  }
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (bonds[cloud.blocks[i]].body != body) continue;
    points.positions.push_back(cloud.positions[i]);
    points.largest_horizon = std::max(points.largest_horizon, horizons[i]);
    points.smallest_horizon = std::min(points.smallest_horizon, horizons[i]);
  }
  return points;
}

// Collective. The largest length of which all coordinates along an axis are multiples, from `low` on, whatever ranks
// they are on; by Euclid's algorithm, until it is too short for a lattice. Infinite where all are alike.
double common_step(const std::vector<Vector>& positions, int axis, double low, double size, double horizon,
                   const Communicator& communicator) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (double step = infinite;;) {
    double rest = infinite;
    for (const Vector& X : positions) {
      const double x = X[axis] - low, off = std::abs(x - (step < infinite ? std::round(x / step) * step : 0));
      if (off > 1e-6 * horizon) rest = std::min(rest, off);  // more than round-off
    }
    rest = communicator.min(rest);
    if (rest == infinite) return step;
    const double cells = std::round(size / rest);
    step = std::abs(size / rest - cells) < 1e-3 ? size / cells : rest;  // of many cells: free of round-off
    if (step * (LatticeFamilies::width + 1) < horizon) return step;
  }
}

// True if all points are at cells of the frame.
bool fits(const LatticeFrame& frame, const std::vector<Vector>& positions) {
  return std::all_of(positions.begin(), positions.end(), [&](const Vector& X) { return frame.has(X); });
}

// True if a grid over the body takes less memory than lists: 64 bytes per point are 16 neighbors.
bool is_compact(const LatticeFrame& frame, const Eigen::Array3d& size, double points) {
  Eigen::Array3d cells = (size + 2 * frame.horizon) / frame.spacing.array() + 1;
  cells[0] = cells[0] / LatticeFamilies::width + 4;
  return cells.prod() * sizeof(int) <= 64 * points + (1 << 20);
}

// Collective.
std::optional<LatticeFrame> frame_of(const BodyPoints& points, int body, const Communicator& communicator) {
  const double largest = communicator.max(points.largest_horizon), smallest = communicator.min(points.smallest_horizon);
  const auto count = communicator.sum(static_cast<std::int64_t>(points.positions.size()));
  if (count == 0 || points.wants_lists || !(largest - smallest <= 1e-12 * largest)) return {};
  LatticeFrame frame{
      .horizon = largest, .body = body, .wanted = points.wants_stencil, .loses_bonds = points.loses_bonds};
  Eigen::AlignedBox3d mine;
  for (const Vector& X : points.positions) mine.extend(X);
  const Eigen::AlignedBox3d box = common_box(mine, communicator);
  frame.origin = box.min();
  for (int axis = 0; axis < 3; ++axis) {
    const double size = box.sizes()[axis];
    const double step = common_step(points.positions, axis, frame.origin[axis], size, largest, communicator);
    const double cells = std::round(size / step);
    frame.spacing[axis] = cells > 0 ? size / cells : largest;  // the mean step is free of round-off
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (cells_within(frame, axis) > LatticeFamilies::width) return {};
  }
  if (!is_compact(frame, box.sizes().array(), static_cast<double>(count))) return {};
  if (communicator.any(!fits(frame, points.positions))) return {};
  return frame;
}

}  // namespace

bool LatticeFrame::has(const Vector& X) const {
  const Eigen::Array3d cell = (X - origin).array() / spacing.array();
  return ((cell - cell.round()).abs() <= tolerance).all();
}

void LatticeFrame::make_room() {
  for (int axis = 0; axis < 3; ++axis) {
    const int pencils = cells_within(*this, axis) / LatticeFamilies::width + 1;
    origin[axis] -= pencils * LatticeFamilies::width * spacing[axis];
  }
}

Eigen::Array3i LatticeFrame::cell_of(const Vector& X) const {
  return ((X - origin).array() / spacing.array()).round().cast<int>();
}

std::vector<LatticeFrame> lattice_frames(const PointCloud& cloud, const std::vector<double>& horizons,
                                         const std::vector<BlockBonds>& bonds, const Communicator& communicator) {
  std::vector<int> bodies;
  for (const BlockBonds& block : bonds) bodies.push_back(block.body);
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  std::vector<LatticeFrame> frames;
  for (const int body : bodies) {
    const auto frame = frame_of(points_of(cloud, horizons, bonds, body), body, communicator);
    if (frame) frames.push_back(*frame);
  }
  return frames;
}

// ---- Slots ---------------------------------------------------------------------------------------------------------

// The grid: pencils along x, then y, then z; with a margin for the stencil around every slot.
struct LatticeFamilies::Box {
  Eigen::Array3i low, shape;  // x in pencils

  int index(const Eigen::Array3i& cell) const {
    const Eigen::Array3i p = Eigen::Array3i(cell[0] / width, cell[1], cell[2]) - low;
    return (p[2] * shape[1] + p[1]) * shape[0] + p[0];
  }
};

LatticeFamilies::LatticeFamilies(const LatticeFrame& frame, const std::vector<Vector>& positions,
                                 const std::vector<int>& members, int owned)
    : frame_(frame), cell_(positions.size(), -1) {
  std::vector<Eigen::Array3i> cells;
  cells.reserve(members.size());
  Eigen::Array3i low = Eigen::Array3i::Constant(std::numeric_limits<int>::max() / 2), high = -low;
  for (const int i : members) {
    cells.push_back(frame.cell_of(positions[i]));
    low = low.min(cells.back()), high = high.max(cells.back());
  }
  if (members.empty()) low = high = Eigen::Array3i::Zero();
  const Eigen::Array3i margin(2, cells_within(frame, 1), cells_within(frame, 2));
  low[0] /= width, high[0] /= width;
  const Box box{low - margin, high - low + 2 * margin + 1};
  make_rows(box);
  make_slots(box, members, cells, owned);
}

void LatticeFamilies::make_rows(const Box& box) {
  const Vector& h = frame_.spacing;
  const int far_y = cells_within(frame_, 1), far_z = cells_within(frame_, 2);
  rows_across_ = 2 * far_y + 1;
  for (int z = -far_z; z <= far_z; ++z) {
    for (int y = -far_y; y <= far_y; ++y) {
      int reach = -1;
      while (bonded(frame_.horizon, frame_.horizon, Vector((reach + 1) * h[0], y * h[1], z * h[2]))) ++reach;
      reach_ = std::max(reach_, reach);
      if (reach >= 0) rows_.push_back({y, z, reach, (z * box.shape[1] + y) * box.shape[0]});
    }
  }
}

void LatticeFamilies::make_slots(const Box& box, const std::vector<int>& members,
                                 const std::vector<Eigen::Array3i>& cells, int owned) {
  grid_.assign(static_cast<std::size_t>(box.shape.cast<double>().prod()), 0);
  for (const Eigen::Array3i& cell : cells) {
    const int index = box.index(cell), x = cell[0] % width;
    grid_[index] = 1;
    if (x < reach_) grid_[index - 1] = 1;
    if (x >= width - reach_) grid_[index + 1] = 1;
  }
  places_ = {0};
  shape_ = box.shape;
  for (int index = 0; index < static_cast<int>(grid_.size()); ++index) {
    if (grid_[index] == 0) continue;
    grid_[index] = slots();
    places_.push_back(index);
  }
  points_.assign(static_cast<std::size_t>(slots()) * width, -1);
  filled_.assign(slots(), 0);
  owned_.assign(slots(), 0);
  for (std::size_t m = 0; m < members.size(); ++m) {
    const int i = members[m], slot = grid_[box.index(cells[m])];
    cell_[i] = slot * width + cells[m][0] % width;
    points_[cell_[i]] = i;
    filled_[slot] |= 1u << cells[m][0] % width;
    if (i < owned) owned_[slot] = 1;
  }
}

bool LatticeFamilies::begins_run(int i) const {
  const int index = places_[cell_[i] / width], lane = cell_[i] % width;
  return lane > 0 ? !has_point(index, lane - 1) : !has_point(index - 1, width - 1);
}

std::size_t LatticeFamilies::family_size(int i) const {
  const int index = places_[cell_[i] / width], lane = cell_[i] % width;
  std::size_t count = 0;
  for (const Row& row : rows_) count += std::popcount(neighbors_in(row, &grid_[index + row.offset], lane));
  return count - 1;  // without the point itself
}

bool LatticeFamilies::spans_space(int i) const {
  if (!(frame_.spacing.array() <= frame_.horizon).all()) return false;
  const int index = places_[cell_[i] / width], lane = cell_[i] % width;
  const auto beside = [&](int dx, int dy, int dz) {
    const int x = lane + dx, row = index + (dz * shape_[1] + dy) * shape_[0];
    return has_point(row + (x + width) / width - 1, (x + width) % width) ? 1 : 0;
  };
  const int along_x = beside(-1, 0, 0) + beside(1, 0, 0), along_y = beside(0, -1, 0) + beside(0, 1, 0);
  const int along_z = beside(0, 0, -1) + beside(0, 0, 1);
  return along_x > 0 && along_y > 0 && along_z > 0 && along_x + along_y + along_z > 3;
}

double LatticeFamilies::bytes() const {
  const std::size_t numbers = grid_.size() + places_.size() + points_.size() + cell_.size();
  return static_cast<double>(sizeof(int) * numbers + owned_.size() + filled_.size());
}

}  // namespace strut
