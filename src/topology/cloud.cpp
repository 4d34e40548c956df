#include "topology/cloud.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

double reach_of_cell(const PointCloud& cloud, double volume, int i, const Vector& direction) {
  if (cloud.shapes.empty()) return cloud.at == PointsAt::nodes ? 0 : 0.5 * std::cbrt(volume);
  const CellShape& shape = cloud.shapes[i];
  const double moment = direction.dot(to_tensor(shape.moments) * direction);
  return std::max(0.0, direction.dot(shape.offset) + std::sqrt(3 * moment));
}

}  // namespace strut
