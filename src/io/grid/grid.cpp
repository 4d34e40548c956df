#include "io/grid/grid.hpp"

#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace {

// Numbers on disk have 32 bits.
void check_count(const std::array<int, 3>& points) {
  const double count = static_cast<double>(points[0]) * points[1] * points[2];
  if (count < std::numeric_limits<int>::max()) return;
  throw Error("Discretization > TensorProduct3DMeshGenerator: " + std::to_string(static_cast<long long>(count)) +
              " points; expected less than 2147483647");
}

// Where the cell of a number is, x fastest.
std::array<int, 3> place_of(std::int64_t number, const std::array<int, 3>& points) {
  const std::int64_t row = number / points[0];
  return {static_cast<int>(number % points[0]), static_cast<int>(row % points[1]), static_cast<int>(row / points[1])};
}

// The cells from number `begin` to before `end`.
PointCloud part_of_grid(const Vector& origin, const Vector& cell, const std::array<int, 3>& points, std::int64_t begin,
                        std::int64_t end) {
  PointCloud cloud;
  for (std::int64_t number = begin; number < end; ++number) {
    const auto [i, j, k] = place_of(number, points);
    cloud.ids.push_back(number);
    cloud.element_ids.push_back(number + 1);
    cloud.positions.push_back(origin + cell.cwiseProduct(Vector(i + 0.5, j + 0.5, k + 0.5)));
  }
  cloud.volumes.assign(cloud.size(), cell.prod());
  cloud.spacings.assign(cloud.size(), std::cbrt(cell.prod()));
  cloud.blocks.assign(cloud.size(), 0);
  cloud.sets.assign(cloud.size(), 0);
  cloud.block_names = {"block_1"};
  return cloud;
}

// The part of the box's surface that cell `at` of so many along each axis has.
void set_surface(const std::array<int, 3>& at, const std::array<int, 3>& points, const Vector& cell, CellShape& shape) {
  for (int axis = 0; axis < 3; ++axis) {
    const int upper = at[axis] == points[axis] - 1 ? 1 : 0, lower = at[axis] == 0 ? 1 : 0;
    shape.surface[axis] = (upper - lower) * cell.prod() / cell[axis];
    shape.surface_moments(axis, axis) = (upper + lower) * cell.prod() / 2;
  }
}

// The corners of a cell, numbered x fastest.
std::vector<std::int64_t> corners_of(const std::array<int, 3>& at, const std::array<int, 3>& points) {
  std::vector<std::int64_t> corners;
  for (const std::int64_t z : {at[2], at[2] + 1}) {
    for (const std::int64_t y : {at[1], at[1] + 1}) {
      for (const std::int64_t x : {at[0], at[0] + 1}) {
        corners.push_back((z * (points[1] + 1) + y) * (points[0] + 1) + x);
      }
    }
  }
  return corners;
}

void add_cells(const Vector& cell, const std::array<int, 3>& points, PointCloud& cloud) {
  const Vector squares = cell.cwiseAbs2() / 12;
  for (const std::int64_t id : cloud.ids) {
    const std::array<int, 3> at = place_of(id, points);
    CellShape& shape = cloud.shapes.emplace_back();
    shape.moments.head<3>() = squares;
    set_surface(at, points, cell, shape);
    cloud.joints.push_back(corners_of(at, points));
  }
  cloud.joined = true;
}

}  // namespace

PointCloud make_grid(const Vector& origin, const Vector& length, const std::array<int, 3>& points,
                     const Communicator& communicator, bool with_cells) {
  check_count(points);
  const Vector cell = length.cwiseQuotient(Vector(points[0], points[1], points[2]));
  const std::int64_t total = std::int64_t{points[0]} * points[1] * points[2];
  PointCloud cloud = part_of_grid(origin, cell, points, slice_begin(total, communicator.size(), communicator.rank()),
                                  slice_begin(total, communicator.size(), communicator.rank() + 1));
  if (with_cells) add_cells(cell, points, cloud);
  return cloud;
}

}  // namespace strut::io
