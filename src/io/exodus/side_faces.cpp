#include "io/exodus/side_faces.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "base/parallel/gather_scatter.hpp"
#include "topology/cloud.hpp"

namespace strut::io {

namespace {

using Key = std::array<std::int64_t, 4>;  // the numbers of the corners, the same on both sides, ascending

Key key_of(const Face& face, const Mesh& mesh, const std::vector<Mirror>& sides) {
  constexpr std::int64_t of_number = (std::int64_t{1} << first_plane_bit) - 1;
  const double size = std::sqrt(face.area.norm());
  Key key{};
  for (int c = 0; c < 4; ++c) {
    const int node = face.nodes[c];
    key[c] = node < 0 ? -1 : shared_node_at(mesh.nodes[node], node, sides, size) & of_number;
  }
  std::ranges::sort(key);
  return key;
}

// Collective. How often each key is on all ranks, which send it to the one that counts it.
std::vector<int> counts_of(const std::vector<Key>& keys, const Communicator& communicator) {
  const auto owner = [&](const Key& key) { return static_cast<std::size_t>(key[3] % communicator.size()); };
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return owner(keys[k]); });
  std::vector<std::int64_t> to_ranks(static_cast<std::size_t>(communicator.size()), 0);
  std::vector<Key> leaving;
  for (const std::size_t k : order) leaving.push_back(keys[k]), ++to_ranks[owner(keys[k])];
  const std::vector<std::int64_t> from_ranks = counts_from_ranks(communicator, to_ranks);
  const std::vector<Key> arrived = exchange<Key>(communicator, leaving, to_ranks, from_ranks);
  std::map<Key, int> found;
  for (const Key& key : arrived) ++found[key];
  std::vector<int> answers;
  for (const Key& key : arrived) answers.push_back(found[key]);
  const std::vector<int> mine = exchange<int>(communicator, answers, from_ranks, to_ranks);
  std::vector<int> counts(keys.size());
  for (std::size_t n = 0; n < order.size(); ++n) counts[order[n]] = mine[n];
  return counts;
}

}  // namespace

std::vector<Face> without_continued(const std::vector<Face>& faces, const MeshSlice& slice,
                                    const std::vector<Mirror>& planes, const Communicator& communicator) {
  std::vector<Mirror> mirrors, sides;
  for (const Mirror& plane : planes) (plane.period > 0 ? sides : mirrors).push_back(plane);
  std::vector<Face> surface, on_sides;
  std::vector<Key> keys;
  for (const Face& face : faces) {
    if (is_on(mirrors, face, slice.mesh)) continue;
    if (!is_on(sides, face, slice.mesh)) {
      surface.push_back(face);
      continue;
    }
    on_sides.push_back(face);
    keys.push_back(key_of(face, slice.mesh, sides));
  }
  const bool any_triangle = std::ranges::any_of(on_sides, [](const Face& face) { return face.nodes[3] < 0; });
  // Triangles may halve the faces of either side in their own way: of their meshes both sides must be alike.
  if (communicator.max(any_triangle ? 1.0 : 0.0) > 0) return surface;
  const std::vector<int> counts = counts_of(keys, communicator);
  for (std::size_t k = 0; k < on_sides.size(); ++k) {
    if (counts[k] == 1) surface.push_back(on_sides[k]);
  }
  std::ranges::stable_sort(surface, {}, &Face::element);
  return surface;
}

}  // namespace strut::io
