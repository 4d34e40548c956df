// The material points of one rank, as a reader delivers them and the partition distributes them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut {

// The entities of the mesh that points represent. A text mesh has points only: they count as elements.
enum class PointsAt { elements, nodes };

// "element" or "node", for messages.
constexpr const char* word(PointsAt at) { return at == PointsAt::nodes ? "node" : "element"; }

// The part of a body that a point represents, by integrals over it, in addition to the volume.
struct CellShape {
  Vector offset = Vector::Zero();           // from the point to the centroid, m
  Symmetric moments = Symmetric::Zero();    // central second moments per volume, m²: of a cube h²/12 (xx, yy, zz)
  Vector surface = Vector::Zero();          // ∫ n dA over the part of the body's surface in the cell, n outward, m²
  Tensor surface_moments = Tensor::Zero();  // ∫ n ⊗ (x − X) dA over it, X the point, m³
};

// A shape, in the form in which it is sent to other ranks.
using ShapeNumbers = std::array<double, 21>;
inline ShapeNumbers numbers_of(const CellShape& shape) {
  ShapeNumbers numbers;
  Eigen::Map<Vector>(numbers.data()) = shape.offset;
  Eigen::Map<Symmetric>(numbers.data() + 3) = shape.moments;
  Eigen::Map<Vector>(numbers.data() + 9) = shape.surface;
  Eigen::Map<Tensor>(numbers.data() + 12) = shape.surface_moments;
  return numbers;
}
inline CellShape shape_of(const ShapeNumbers& numbers) {
  return {Eigen::Map<const Vector>(numbers.data()), Eigen::Map<const Symmetric>(numbers.data() + 3),
          Eigen::Map<const Vector>(numbers.data() + 9), Eigen::Map<const Tensor>(numbers.data() + 12)};
}

constexpr int first_void_bit = 34, first_plane_bit = 48, most_planes = 14;

struct PointCloud {
  // One entry per point.
  std::vector<std::int64_t> ids;          // 0-based index in the order of the file: unique over all ranks
  std::vector<std::int64_t> element_ids;  // the mesh's own number of the element or node
  std::vector<Vector> positions;          // reference position X, m
  std::vector<double> volumes;            // m³
  std::vector<double> spacings;           // m: the edge of a cube as large as the elements here (see io/README.md)
  std::vector<int> blocks;                // index into block_names
  std::vector<std::uint64_t> sets;        // bit k: the point is in node set set_names[k]
  // Empty unless they were asked for, and if the file does not contain them (text):
  std::vector<CellShape> shapes;
  // Shared nodes: numbers that a point has in common with the points that it touches, ascending. They are the nodes of
  // an element, or the elements around a node. Two points touch if they have one of these numbers in common. Bits from
  // first_plane_bit on: the symmetry planes or periodic sides that a node lies on (shared_node_at). Bits from
  // first_void_bit on, for planes alone: that no element is filled there up to the plane.
  std::vector<std::vector<std::int64_t>> shared_nodes;

  // The same on all ranks.
  PointsAt at = PointsAt::elements;
  bool has_shared_nodes = false;  // every point has shared nodes
  std::vector<std::string> block_names;
  std::vector<std::string> set_names;  // at most 64
  // For points at nodes as they are read, by pairs of blocks: volume of the elements of the second block that points of
  // the first have, m³. Else empty.
  std::vector<double> taken_volumes;

  std::size_t size() const { return ids.size(); }
};

// The extent of a cell beyond its point in a direction of unit length, m. From the cell's moments: for a slab √3 times
// the root of its second moment.
inline double extent_of(const CellShape& shape, const Vector& direction) {
  const double moment = direction.dot(to_tensor(shape.moments) * direction);
  return std::max(0.0, direction.dot(shape.offset) + std::sqrt(3 * moment));
}

// The same for the cell of point i, of this volume (m³), as far as a body reaches beyond its points. Without shapes in
// the cloud, that of a cube; 0 for a node, with or without shapes, because nodes at a surface lie on it.
inline double reach_of_cell(const PointCloud& cloud, double volume, int i, const Vector& direction) {
  if (cloud.at == PointsAt::nodes) return 0;
  return cloud.shapes.empty() ? 0.5 * std::cbrt(volume) : extent_of(cloud.shapes[i], direction);
}

// A face of a cell on symmetry planes of the deck: surface, unless its body goes on behind one of these.
struct FaceOnPlanes {
  std::size_t point = 0;            // index in the cloud
  std::uint32_t planes = 0;         // the bits (Mirror::bit) of those that it lies on
  Vector area = Vector::Zero();     // as CellShape::surface, m²
  Tensor moments = Tensor::Zero();  // as CellShape::surface_moments, m³
};
using FacesOnPlanes = std::vector<FaceOnPlanes>;

// Adds a face to the surface of its point's cell; if it lies on planes, to those `apart` instead, or to none (null).
inline void add_face(const FaceOnPlanes& face, PointCloud& cloud, FacesOnPlanes* apart = nullptr) {
  if (face.planes == 0) {
    cloud.shapes[face.point].surface += face.area;
    cloud.shapes[face.point].surface_moments += face.moments;
  } else if (apart) {
    apart->push_back(face);
  }
}

}  // namespace strut
