#include "io/grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace {

// Integers on disk have 32 bits.
void check_count(const std::array<int, 3>& points) {
  const double count = static_cast<double>(points[0]) * points[1] * points[2];
  if (count < std::numeric_limits<int>::max()) return;
  throw Error("Discretization > TensorProduct3DMeshGenerator: " + std::to_string(static_cast<long long>(count)) +
              " points; expected less than 2147483647");
}

// The indices of the cell with a number, x fastest.
std::array<int, 3> place_of(std::int64_t number, const std::array<int, 3>& points) {
  const std::int64_t row = number / points[0];
  return {static_cast<int>(number % points[0]), static_cast<int>(row % points[1]), static_cast<int>(row / points[1])};
}

// The cells from number `begin` up to `end`.
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

// Adds the face of the last cell at X[axis] + half (±half an edge), X the cell's center; none on a periodic side, where
// the grid continues.
void add_end(const Vector& cell, int axis, double half, const std::vector<Mirror>& planes, PointCloud& cloud,
             FacesOnPlanes* apart) {
  FaceOnPlanes face{.point = cloud.shapes.size() - 1};
  const Vector middle = cloud.positions[face.point] + half * Vector::Unit(axis);
  for (const Mirror& plane : planes) {
    if (std::abs(std::abs(plane.normal[axis]) - 1) > 1e-6 || !plane.holds(middle, cell.minCoeff())) continue;
    if (plane.period > 0) return;
    face.planes |= std::uint32_t{1} << plane.bit;
  }
  face.area[axis] = std::copysign(cell.prod() / cell[axis], half);
  face.moments(axis, axis) = cell.prod() / 2;
  add_face(face, cloud, apart);
}

// Adds the part of the box's surface in the last cell, which has the indices `at`.
void add_surface(const std::array<int, 3>& at, const std::array<int, 3>& points, const Vector& cell,
                 const std::vector<Mirror>& planes, PointCloud& cloud, FacesOnPlanes* apart) {
  for (int axis = 0; axis < 3; ++axis) {
    if (at[axis] == points[axis] - 1) add_end(cell, axis, 0.5 * cell[axis], planes, cloud, apart);
    if (at[axis] == 0) add_end(cell, axis, -0.5 * cell[axis], planes, cloud, apart);
  }
}

// The corners of a cell, numbered x fastest, with the bits of the planes that they lie on (PointCloud::shared_nodes).
std::vector<std::int64_t> corners_of(const std::array<int, 3>& at, const std::array<int, 3>& points, const Vector& cell,
                                     const Vector& origin, const std::vector<Mirror>& planes) {
  std::vector<std::int64_t> corners;
  for (const std::int64_t z : {at[2], at[2] + 1}) {
    for (const std::int64_t y : {at[1], at[1] + 1}) {
      for (const std::int64_t x : {at[0], at[0] + 1}) {
        const std::int64_t number = (z * (points[1] + 1) + y) * (points[0] + 1) + x;
        corners.push_back(shared_node_at(origin + cell.cwiseProduct(Vector(x, y, z)), number, planes, cell.minCoeff()));
      }
    }
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

void add_cells(const Vector& cell, const Vector& origin, const std::array<int, 3>& points,
               const std::vector<Mirror>& planes, PointCloud& cloud, FacesOnPlanes* apart) {
  const Vector squares = cell.cwiseAbs2() / 12;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::int64_t id = cloud.ids[i];
    const std::array<int, 3> at = place_of(id, points);
    cloud.shapes.emplace_back().moments.head<3>() = squares;
    add_surface(at, points, cell, planes, cloud, apart);
    cloud.shared_nodes.push_back(corners_of(at, points, cell, origin, planes));
  }
  cloud.has_shared_nodes = true;
}

// Two cells are at most n apart along each axis if, and only if, a box of n + 1 cells holds both. Boxes are numbered by
// their first cells, x fastest, and may stand out of the grid.
void add_boxes(const std::array<int, 3>& points, const std::array<int, 3>& reach, PointCloud& cloud) {
  for (const std::int64_t id : cloud.ids) {
    const std::array<int, 3> at = place_of(id, points);
    std::vector<std::int64_t>& boxes = cloud.shared_nodes.emplace_back();
    for (std::int64_t z = at[2]; z <= at[2] + reach[2]; ++z) {
      for (std::int64_t y = at[1]; y <= at[1] + reach[1]; ++y) {
        for (std::int64_t x = at[0]; x <= at[0] + reach[0]; ++x) {
          boxes.push_back((z * (points[1] + reach[1]) + y) * (points[0] + reach[0]) + x);
        }
      }
    }
  }
  cloud.has_shared_nodes = true;
}

}  // namespace

PointCloud make_grid(const Vector& origin, const Vector& length, const std::array<int, 3>& points,
                     const Communicator& communicator, bool with_cells, const std::vector<Mirror>& planes,
                     const std::optional<std::array<int, 3>>& box, FacesOnPlanes* apart) {
  check_count(points);
  const Vector cell = length.cwiseQuotient(Vector(points[0], points[1], points[2]));
  const std::int64_t total = std::int64_t{points[0]} * points[1] * points[2];
  PointCloud cloud = part_of_grid(origin, cell, points, slice_begin(total, communicator.size(), communicator.rank()),
                                  slice_begin(total, communicator.size(), communicator.rank() + 1));
  if (with_cells) add_cells(cell, origin, points, planes, cloud, apart);
  if (box) cloud.shared_nodes.clear(), add_boxes(points, *box, cloud);
  return cloud;
}

}  // namespace strut::io
