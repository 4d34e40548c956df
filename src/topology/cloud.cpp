#include "topology/cloud.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

double reach_of_cell(const PointCloud& cloud, double volume, int i, const Vector& direction) {
  if (cloud.at == PointsAt::nodes) return 0;
  return cloud.shapes.empty() ? 0.5 * std::cbrt(volume) : extent_of(cloud.shapes[i], direction);
}

double extent_of(const CellShape& shape, const Vector& direction) {
  const double moment = direction.dot(to_tensor(shape.moments) * direction);
  return std::max(0.0, direction.dot(shape.offset) + std::sqrt(3 * moment));
}

}  // namespace strut
