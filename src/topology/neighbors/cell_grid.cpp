#include "topology/neighbors/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

CellGrid::CellGrid(const std::vector<Vector>& points, double reach, double width) {
  Eigen::AlignedBox3d box;
  for (const Vector& x : points) box.extend(x);
  if (points.empty()) box.extend(Vector::Zero());
  origin_ = box.min();
  // Sparse clouds in a large box get wider cells, so that memory stays proportional to the number of points. In a long
  // thin box, as with a point that has flown off, rows of single cells would still be too many.
  const double volume = (box.sizes().array() + width).prod(), enough = 8.0 * points.size() + 64;
  width_ = std::max(width, std::cbrt(volume / enough));
  while (((box.sizes() / width_).array().floor() + 1).prod() > 8 * enough) width_ *= 2;
  cells_within_reach_ = static_cast<int>(std::ceil(reach / width_));
  shape_ = (box.sizes() / width_).array().floor().cast<int>() + 1;
  start_.assign(static_cast<std::size_t>(shape_[0]) * shape_[1] * shape_[2] + 1, 0);
  std::vector<std::size_t> cells(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Eigen::Array3i c = cell_of(points[p]);
    cells[p] = index(c[0], c[1], c[2]);
    ++start_[cells[p] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  members_.resize(points.size());
  places_.resize(points.size());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const int place = next[cells[p]]++;
    members_[place] = static_cast<int>(p);
    places_[place] = points[p];
  }
}

Eigen::Array3i CellGrid::cell_of(const Vector& x) const {
  return ((x - origin_) / width_).array().floor().cast<int>().max(0).min(shape_ - 1);
}

}  // namespace strut
