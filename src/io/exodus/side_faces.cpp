#include "io/exodus/side_faces.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "base/parallel/gather_scatter.hpp"
#include "topology/cloud.hpp"

namespace strut::io {

namespace {

using Key = std::array<std::int64_t, 4>;  // the numbers of the corners, the same on both sides, ascending

Key key_of(const Face& face, const Mesh& mesh, const std::vector<Mirror>& sides,
           const std::vector<std::int64_t>& seams) {
  constexpr std::int64_t of_number = (std::int64_t{1} << first_plane_bit) - 1;
  const double size = std::sqrt(face.area.norm());
  Key key{};
  for (int c = 0; c < 4; ++c) {
    const int node = face.nodes[c];
    key[c] = node < 0 ? -1 : shared_node_at(mesh.nodes[node], node, sides, size, seams[node]) & of_number;
  }
  std::ranges::sort(key);
  return key;
}

// The ways of keys to the ranks that count them.
Routes to_owners(const std::vector<Key>& keys, const Communicator& communicator) {
  std::vector<int> owners;
  for (const Key& key : keys) owners.push_back(static_cast<int>(key[3] % communicator.size()));
  return {communicator, owners};
}

// Collective. For each of the keys `asked`, how often it is among the keys of all ranks.
std::vector<int> counts_of(const std::vector<Key>& asked, const std::vector<Key>& keys,
                           const Communicator& communicator) {
  std::map<Key, int> found;
  for (const Key& key : to_owners(keys, communicator).there(keys)) ++found[key];
  const Routes routes = to_owners(asked, communicator);
  std::vector<int> answers;
  for (const Key& key : routes.there(asked)) answers.push_back(found.contains(key) ? found[key] : 0);
  return routes.back(answers);
}

// A face on one of the sides.
struct SideFace {
  Face face;
  Key key;
  int side;  // index of the side; sides that meet are 2n and 2n + 1 (setup/periods.cpp)
  std::size_t corners() const { return face.corners().size(); }
};

std::vector<Key> keys_of(const std::vector<SideFace>& faces) {
  std::vector<Key> keys;
  for (const SideFace& one : faces) keys.push_back(one.key);
  return keys;
}

// Collective. The faces that no face with the same corners meets.
std::vector<SideFace> without_twin(const std::vector<SideFace>& faces, const Communicator& communicator) {
  const std::vector<Key> keys = keys_of(faces);
  const std::vector<int> counts = counts_of(keys, keys, communicator);
  std::vector<SideFace> alone;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (counts[k] == 1) alone.push_back(faces[k]);
  }
  return alone;
}

// Collective. The faces that are not continued by other triangles: behind the other side, tetrahedra may halve a square
// along its other diagonal, so a face is continued if all of its corners are corners of such triangles.
std::vector<SideFace> without_halves(const std::vector<SideFace>& faces, const Communicator& communicator) {
  std::vector<Key> corners, asked;
  for (const SideFace& one : faces) {
    for (std::size_t c = 4 - one.corners(); c < 4; ++c) {
      if (one.corners() == 3) corners.push_back({0, 0, one.side, one.key[c]});
      asked.push_back({0, 0, one.side ^ 1, one.key[c]});
    }
  }
  const std::vector<int> counts = counts_of(asked, corners, communicator);
  std::vector<SideFace> left;
  auto count = counts.begin();
  for (const SideFace& one : faces) {
    const auto end = count + static_cast<std::ptrdiff_t>(one.corners());
    if (std::any_of(count, end, [](int found) { return found == 0; })) left.push_back(one);
    count = end;
  }
  return left;
}

}  // namespace

std::vector<Face> without_continued(const std::vector<Face>& faces, const MeshSlice& slice,
                                    const std::vector<Mirror>& planes, const std::vector<std::int64_t>& seams,
                                    const Communicator& communicator) {
  std::vector<Mirror> sides;
  std::ranges::copy_if(planes, std::back_inserter(sides), [](const Mirror& plane) { return plane.period > 0; });
  if (sides.empty()) return faces;
  std::vector<Face> surface;
  std::vector<SideFace> on_sides;
  for (const Face& face : faces) {
    const auto side = std::ranges::find_if(sides, [&](const Mirror& one) { return is_on(one, face, slice.mesh); });
    if (side == sides.end()) {
      surface.push_back(face);
    } else {
      on_sides.push_back({face, key_of(face, slice.mesh, sides, seams), static_cast<int>(side - sides.begin())});
    }
  }
  for (const SideFace& one : without_halves(without_twin(on_sides, communicator), communicator))
    surface.push_back(one.face);
  std::ranges::stable_sort(surface, {}, &Face::element);
  return surface;
}

}  // namespace strut::io
