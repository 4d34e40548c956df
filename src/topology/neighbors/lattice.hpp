// Bodies whose points are on a lattice: neighbors follow from the positions in it, and no bond is stored.
//
// The lattice is divided into pencils of eight cells along x. Pencils with points of this rank (owned or ghosts), and
// those beside them in x that rows reach, have slots: numbers from 1 on, ordered by z, y, x. Slot 0 stands for all
// empty pencils. A grid over the bounding box stores the slot of each pencil. The family of a point is a stencil: rows
// (y, z) of cells with |x| ≤ the row's reach.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "base/math/pencil.hpp"
#include "base/math/tensors.hpp"
#include "base/parallel/communicator.hpp"
#include "topology/neighbors/block_bonds.hpp"

namespace strut {

struct PointCloud;

// Position of the lattice of a body, the same on all ranks.
struct LatticeFrame {
  Vector origin = Vector::Zero();   // m, the smallest coordinates
  Vector spacing = Vector::Ones();  // m
  double horizon = 0;               // m, of all points of the body
  int body = 0;                     // BlockBonds::body
  bool wanted = false;              // use it even if lists are faster
  bool loses_bonds = false;         // its bonds may break, so its points have lists, too

  Eigen::Array3i cell_of(const Vector& X) const;
  bool has(const Vector& X) const;  // the point is at a cell
  void make_room();                 // moves the origin back, so that images of points within the horizon have cells
};

// Collective. The bodies whose points are on a lattice. Excluded: coordinates off by more than 1e-9 spacings; horizons
// that differ or exceed a pencil; blocks that want lists; too few points in a large box, so that the grid would take
// more memory than lists.
std::vector<LatticeFrame> lattice_frames(const PointCloud& cloud, const std::vector<double>& horizons,
                                         const std::vector<BlockBonds>& bonds, const Communicator& communicator);

class LatticeFamilies {
 public:
  static constexpr int width = pencil_width;  // cells per pencil

  struct Row {
    int y, z;    // of the neighbors, in cells from the point
    int reach;   // their x is in [−reach, reach]
    int offset;  // in the grid
  };

  // The points of one body: `members` are their local indices, owned (below `owned`) and ghosts.
  LatticeFamilies(const LatticeFrame& frame, const std::vector<Vector>& positions, const std::vector<int>& members,
                  int owned);

  // Calls visit(j) over the family of point i.
  template <class Visit>
  void for_each(int i, Visit&& visit) const {
    const int index = places_[cell_[i] / width], lane = cell_[i] % width;
    for (const Row& row : rows_) {
      const int* slots = &grid_[index + row.offset];
      for (unsigned near = neighbors_in(row, slots, lane); near != 0; near &= near - 1) {
        const int x = std::countr_zero(near);  // counted from the first cell of the pencil before
        const int j = points_[slots[x / width - 1] * width + x % width];
        if (j != i) visit(j);
      }
    }
  }

  std::size_t family_size(int i) const;
  // True if the family has a neighbor along each axis and another point, so that it spans space.
  bool spans_space(int i) const;

  const LatticeFrame& frame() const { return frame_; }
  const std::vector<Row>& rows() const { return rows_; }
  int reach() const { return reach_; }              // of the longest row
  int rows_across() const { return rows_across_; }  // extent of its rows along y
  int cell(int i) const { return cell_[i]; }  // slot · width + position in the pencil; −1 for points of other bodies
  int point(int slot, int lane) const { return points_[slot * width + lane]; }  // −1: none
  int slots() const { return static_cast<int>(places_.size()); }
  int slot_at(int index) const { return grid_[index]; }  // 0: empty
  int index(int slot) const { return places_[slot]; }
  bool is_owned(int slot) const { return owned_[slot] != 0; }  // has a point that this rank owns

  // A position in the grid is (z · shape()[1] + y) · shape()[0] + x, x in pencils; z = 0 is the lowest plane that
  // this rank stores. Points are farther from its faces than the reach of a stencil.
  const Eigen::Array3i& shape() const { return shape_; }

  // True if the cell before it in x is empty, so that a run of points begins here.
  bool begins_run(int i) const;
  double bytes() const;

 private:
  // The cells with points within a row's reach of the cell at `lane`: a bit each, from the first cell of the pencil
  // before. `slots`: of the pencil at the row; those before and after it are adjacent in memory.
  unsigned neighbors_in(const Row& row, const int* slots, int lane) const {
    const unsigned filled = filled_[slots[-1]] | filled_[slots[0]] << width | filled_[slots[1]] << 2 * width;
    return filled & ((2u << 2 * row.reach) - 1) << (width + lane - row.reach);
  }
  bool has_point(int index, int lane) const { return (filled_[grid_[index]] >> lane & 1) != 0; }

  struct Box;
  void make_rows(const Box& box);
  void make_slots(const Box& box, const std::vector<int>& members, const std::vector<Eigen::Array3i>& cells, int owned);

  LatticeFrame frame_;
  std::vector<Row> rows_;
  std::vector<int> grid_;             // slots
  std::vector<int> places_;           // of slots, in the grid
  std::vector<char> owned_;           // of slots
  std::vector<int> points_;           // of cells; −1: none
  std::vector<std::uint8_t> filled_;  // of slots: a bit for each cell with a point
  std::vector<int> cell_;             // of points
  Eigen::Array3i shape_;
  int reach_ = 0, rows_across_ = 1;
};

}  // namespace strut
