// Initial cracks: no bond crosses them.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "base/math/tensors.hpp"
#include "topology/mirror.hpp"

namespace strut {

struct RectangularCrack {
  Vector corner, normal, along;  // m; of length 1, at right angles
  double length, width;          // m: from the corner along `along`, and along the side, `along` × `normal`
};

struct DiskCrack {
  Vector center, normal;  // m; of length 1
  double radius;          // m
};

// A surface of triangles.
struct TriangulatedCrack {
  std::vector<std::array<Vector, 3>> triangles;  // m
};

using Crack = std::variant<RectangularCrack, DiskCrack, TriangulatedCrack>;

Crack image_of(const Crack& crack, const Reflection& by);

// True if the bond from a to b crosses the crack; symmetric in a and b.
bool crosses(const Crack& crack, const Vector& a, const Vector& b);

}  // namespace strut
