#include "io/grid.hpp"

#include <cmath>
#include <limits>

#include "base/communicator.hpp"
#include "base/errors.hpp"
#include "io/distribute.hpp"

namespace strut::io {

namespace {

// Numbers on disk have 32 bits.
void check_count(const std::array<int, 3>& points) {
  const double count = static_cast<double>(points[0]) * points[1] * points[2];
  if (count < std::numeric_limits<int>::max()) return;
  throw Error("Discretization > TensorProduct3DMeshGenerator: " + std::to_string(static_cast<long long>(count)) +
              " points; expected less than 2147483647");
}

PointCloud whole_grid(const Vector& origin, const Vector& length, const std::array<int, 3>& points) {
  PointCloud cloud;
  const Vector cell = length.cwiseQuotient(Vector(points[0], points[1], points[2]));
  for (int k = 0; k < points[2]; ++k) {
    for (int j = 0; j < points[1]; ++j) {
      for (int i = 0; i < points[0]; ++i) {
        cloud.ids.push_back(static_cast<std::int64_t>(cloud.ids.size()));
        cloud.element_ids.push_back(static_cast<std::int64_t>(cloud.ids.size()));
        cloud.positions.push_back(origin + cell.cwiseProduct(Vector(i + 0.5, j + 0.5, k + 0.5)));
      }
    }
  }
  cloud.volumes.assign(cloud.size(), cell.prod());
  cloud.spacings.assign(cloud.size(), std::cbrt(cell.prod()));
  cloud.blocks.assign(cloud.size(), 0);
  cloud.sets.assign(cloud.size(), 0);
  cloud.block_names = {"block_1"};
  return cloud;
}

}  // namespace

PointCloud make_grid(const Vector& origin, const Vector& length, const std::array<int, 3>& points,
                     const Communicator& communicator) {
  PointCloud whole;
  run_on_root(communicator, [&] {
    check_count(points);
    whole = whole_grid(origin, length, points);
  });
  return distribute(whole, communicator);
}

}  // namespace strut::io
