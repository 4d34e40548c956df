// Points sorted into cubic cells: the search for pairs within a distance.
#pragma once

#include <span>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut {

class CellGrid {
 public:
  // `reach`: the largest distance (m) for visit_near.
  // Cells of half the reach: those visited have 3.7 times the volume of the sphere; with the whole reach 6.4 times.
  CellGrid(const std::vector<Vector>& points, double reach) : CellGrid(points, reach, reach / 2) {}
  // For access by whole cells; the width (m) grows if there would be many times as many cells as points.
  static CellGrid of_width(const std::vector<Vector>& points, double width) { return {points, width, width}; }

  // Calls visit(j, position of j) for every point in the cells within `reach` of x: a superset of the points in reach.
  template <class Visit>
  void visit_near(const Vector& x, Visit&& visit) const;

  // Access by whole cells: the points of cell c, and visit(begin, end) for the rows of cells that meet a box.
  int cells() const { return static_cast<int>(start_.size()) - 1; }
  std::span<const int> members(int c) const { return {members_.data() + start_[c], members_.data() + start_[c + 1]}; }
  template <class Visit>
  void visit_rows(const Eigen::AlignedBox3d& box, Visit&& visit) const;

 private:
  CellGrid(const std::vector<Vector>& points, double reach, double width);
  Eigen::Array3i cell_of(const Vector& x) const;
  std::size_t index(int i, int j, int k) const { return (static_cast<std::size_t>(k) * shape_[1] + j) * shape_[0] + i; }

  Vector origin_ = Vector::Zero();
  double width_ = 1;
  int cells_within_reach_ = 1;
  Eigen::Array3i shape_ = Eigen::Array3i::Ones();
  std::vector<int> start_, members_;
  std::vector<Vector> places_;  // of members_, contiguous for reading
};

template <class Visit>
void CellGrid::visit_near(const Vector& x, Visit&& visit) const {
  const Eigen::Array3i here = cell_of(x);
  const Eigen::Array3i low = (here - cells_within_reach_).max(0), high = (here + cells_within_reach_).min(shape_ - 1);
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      // A row of cells along x is one run of members.
      const int end = start_[index(high[0], j, k) + 1];
      for (int m = start_[index(low[0], j, k)]; m < end; ++m) visit(members_[m], places_[m]);
    }
  }
}

template <class Visit>
void CellGrid::visit_rows(const Eigen::AlignedBox3d& box, Visit&& visit) const {
  const Eigen::Array3i low = cell_of(box.min()), high = cell_of(box.max());
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      visit(static_cast<int>(index(low[0], j, k)), static_cast<int>(index(high[0], j, k)) + 1);
    }
  }
}

}  // namespace strut
