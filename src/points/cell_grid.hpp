// Points sorted into cubic cells: the search for pairs within a distance.
#pragma once

#include <span>
#include <vector>

#include "base/tensors.hpp"

namespace strut {

class CellGrid {
 public:
  // `reach`: the largest distance (m) that will be asked for.
  CellGrid(const std::vector<Vector>& points, double reach);

  // Calls visit(j, place of j) for every point in the cells within `reach` of x: a superset of the points that near.
  template <class Visit>
  void visit_near(const Vector& x, Visit&& visit) const;

  // The same by whole cells: the points of cell c, and visit(d) for the cells within `reach` of it, itself included.
  int cells() const { return static_cast<int>(start_.size()) - 1; }
  std::span<const int> members(int c) const { return {members_.data() + start_[c], members_.data() + start_[c + 1]}; }
  std::span<const Vector> places(int c) const { return {places_.data() + start_[c], members(c).size()}; }
  template <class Visit>
  void visit_cells_near(int c, Visit&& visit) const;

 private:
  Eigen::Array3i cell_of(const Vector& x) const;
  std::size_t index(int i, int j, int k) const { return (static_cast<std::size_t>(k) * shape_[1] + j) * shape_[0] + i; }

  Vector origin_ = Vector::Zero();
  double width_ = 1;
  int cells_within_reach_ = 1;
  Eigen::Array3i shape_ = Eigen::Array3i::Ones();
  std::vector<int> start_, members_;
  std::vector<Vector> places_;  // of members_: read in a row
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
void CellGrid::visit_cells_near(int c, Visit&& visit) const {
  const Eigen::Array3i here(c % shape_[0], c / shape_[0] % shape_[1], c / shape_[0] / shape_[1]);
  const Eigen::Array3i low = (here - cells_within_reach_).max(0), high = (here + cells_within_reach_).min(shape_ - 1);
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) visit(static_cast<int>(index(i, j, k)));
    }
  }
}

}  // namespace strut
