#include "io/exodus/surface.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "base/parallel/gather_scatter.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace {

// A side of an element, with its nodes in ascending order as a key to find the other element that has it.
struct Side {
  std::array<int, 4> key;
  std::int64_t element;
  const int* nodes;  // of the element
  const int* side;
};

void add_sides(const Mesh::Block& block, std::size_t size, std::int64_t first, std::vector<Side>& all) {
  for (std::size_t e = 0; e < block.elements(); ++e) {
    const int* nodes = &block.nodes[e * size];
    for (const auto& side : sides_of(block.type)) {
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
    if (block.type == "HEX8") add_sides(block, 8, elements, sides);
    if (block.type == "TET4") add_sides(block, 4, elements, sides);
    elements += static_cast<std::int64_t>(block.elements());
  }
  return sides;
}

// Half the cross product of the diagonals is ∫ n dA of the bilinear face, plane or not; for a triangle the first node
// counts as the fourth.
Face face_of(const Mesh& mesh, const Side& side) {
  Face face{{-1, -1, -1, -1}, side.element, Vector::Zero()};
  for (int n = 0; n < 4; ++n) face.nodes[n] = side.side[n] < 0 ? -1 : side.nodes[side.side[n]];
  const auto at = [&](int n) { return mesh.nodes[face.nodes[n] < 0 ? face.nodes[0] : face.nodes[n]]; };
  face.area = 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
  return face;
}

// Consecutive sides with the same nodes.
struct Group {
  std::size_t first;  // index in the sorted sides
  std::int64_t count;
};

std::vector<Group> groups_of(std::vector<Side>& sides) {
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tie(a.key, a.element) < std::tie(b.key, b.element); });
  std::vector<Group> groups;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (k == 0 || sides[k].key != sides[k - 1].key) groups.push_back({k, 0});
    ++groups.back().count;
  }
  return groups;
}

// A group in the form in which it is sent to other ranks.
struct Count {
  std::array<int, 4> key;  // indices of nodes in the file
  int count;
};

// For each entry, the sum over all entries with the same key.
std::vector<int> sums_of_equals(const std::vector<Count>& counts) {
  std::vector<std::size_t> order(counts.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return counts[a].key < counts[b].key; });
  std::vector<int> sums(counts.size());
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::find_if(begin, order.end(), [&](auto k) { return counts[k].key != counts[*begin].key; });
    int sum = 0;
    for (auto k = begin; k != end; ++k) sum += counts[*k].count;
    for (auto k = begin; k != end; ++k) sums[*k] = sum;
    begin = end;
  }
  return sums;
}

// Collective. Makes the counts those over all ranks: the rank whose slice has the last node of a side adds them up.
void add_up(const MeshSlice& slice, const Communicator& communicator, const std::vector<Side>& sides,
            std::vector<Group>& groups) {
  std::vector<int> owners;
  std::vector<Count> counts;
  for (const Group& group : groups) {
    Count& count = counts.emplace_back(Count{sides[group.first].key, static_cast<int>(group.count)});
    for (int& node : count.key) node = node < 0 ? node : static_cast<int>(slice.nodes[node]);
    owners.push_back(slice_owner(slice.layout.nodes, communicator.size(), count.key[3]));
  }
  const Routes routes(communicator, owners);
  const std::vector<int> sums = routes.back(sums_of_equals(routes.there(counts)));
  for (std::size_t k = 0; k < groups.size(); ++k) groups[k].count = sums[k];
}

std::vector<Face> faces_of(const Mesh& mesh, const std::vector<Side>& sides, const std::vector<Group>& groups) {
  std::vector<Face> faces;
  for (const Group& group : groups) {
    if (group.count == 1) faces.push_back(face_of(mesh, sides[group.first]));
  }
  return faces;
}

}  // namespace

std::span<const int[4]> sides_of(const std::string& type) {
  static constexpr int hexahedron[6][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
                                           {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  static constexpr int tetrahedron[4][4] = {{0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}, {0, 2, 1, -1}};
  return type == "HEX8" ? std::span<const int[4]>(hexahedron) : std::span<const int[4]>(tetrahedron);
}

bool is_on(const Mirror& plane, const Face& face, const Mesh& mesh) {
  const double size = std::sqrt(face.area.norm());
  return std::ranges::all_of(face.corners(), [&](int node) { return plane.holds(mesh.nodes[node], size); });
}

std::uint32_t planes_of(const std::vector<Mirror>& planes, const Face& face, const Mesh& mesh) {
  std::uint32_t bits = 0;
  for (const Mirror& plane : planes) {
    if (plane.period == 0 && is_on(plane, face, mesh)) bits |= std::uint32_t{1} << plane.bit;
  }
  return bits;
}

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
  const std::vector<Group> groups = groups_of(sides);
  return faces_of(mesh, sides, groups);
}

std::vector<Face> surface_of(const MeshSlice& slice, const Communicator& communicator) {
  std::vector<Side> sides = sides_of(slice.mesh);
  std::vector<Group> groups = groups_of(sides);
  if (communicator.size() > 1) add_up(slice, communicator, sides, groups);
  return faces_of(slice.mesh, sides, groups);
}

}  // namespace strut::io
