// Faces of cells on symmetry planes of the deck: surface, unless their body goes on behind one of these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "topology/cloud.hpp"

namespace strut {

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
