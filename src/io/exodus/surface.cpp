#include "io/exodus/surface.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace strut::io {

namespace {

// Outward by the right hand. The nodes of Exodus' sides.
constexpr int hexahedron_sides[6][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
                                        {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}};
constexpr int tetrahedron_sides[4][4] = {{0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}, {0, 2, 1, -1}};

// A side of an element, to be found again from the other one: by its nodes in ascending order.
struct Side {
  std::array<int, 4> key;
  std::int64_t element;
  const int* nodes;  // of the element
  const int* side;
};

template <std::size_t size, std::size_t count>
void add_sides(const Mesh::Block& block, const int (&sides)[count][4], std::int64_t first, std::vector<Side>& all) {
  for (std::size_t e = 0; e < block.elements(); ++e) {
    const int* nodes = &block.nodes[e * size];
    for (const auto& side : sides) {
      Side& added = all.emplace_back(Side{{}, first + static_cast<std::int64_t>(e), nodes, side});
      for (int n = 0; n < 4; ++n) added.key[n] = side[n] < 0 ? -1 : nodes[side[n]];
      std::sort(added.key.begin(), added.key.end());
    }
  }
}

std::vector<Side> sides_of(const Mesh& mesh) {
  std::vector<Side> sides;
  std::int64_t elements = 0;
  for (const Mesh::Block& block : mesh.blocks) {
    if (block.type == "HEX8") add_sides<8>(block, hexahedron_sides, elements, sides);
    if (block.type == "TET4") add_sides<4>(block, tetrahedron_sides, elements, sides);
    elements += static_cast<std::int64_t>(block.elements());
  }
  return sides;
}

// Half the product of the diagonals is ∫ n dA of the bilinear face, plane or not; of a triangle the fourth node is the
// first.
Face face_of(const Mesh& mesh, const Side& side) {
  Face face{{-1, -1, -1, -1}, side.element, Vector::Zero()};
  for (int n = 0; n < 4; ++n) face.nodes[n] = side.side[n] < 0 ? -1 : side.nodes[side.side[n]];
  const auto at = [&](int n) { return mesh.nodes[face.nodes[n] < 0 ? face.nodes[0] : face.nodes[n]]; };
  face.area = 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
  return face;
}

}  // namespace

Vector Face::middle(const Mesh& mesh) const {
  Vector sum = Vector::Zero();
  for (const int node : corners()) sum += mesh.nodes[node];
  return sum / static_cast<double>(corners().size());
}

Vector Face::middle_at(const Mesh& mesh, std::size_t c) const {
  const std::size_t count = corners().size();
  const Vector here = mesh.nodes[nodes[c]], next = mesh.nodes[nodes[(c + 1) % count]],
               before = mesh.nodes[nodes[(c + count - 1) % count]];
  return (here + 0.5 * (here + next) + 0.5 * (here + before) + middle(mesh)) / 4;
}

std::vector<Face> surface_of(const Mesh& mesh) {
  std::vector<Side> sides = sides_of(mesh);
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tie(a.key, a.element) < std::tie(b.key, b.element); });
  std::vector<Face> faces;
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(), [&](const Side& side) { return side.key != begin->key; });
    if (end - begin == 1) faces.push_back(face_of(mesh, *begin));
    begin = end;
  }
  return faces;
}

}  // namespace strut::io
