#include "io/exodus/unmatched_faces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "base/parallel/gather_scatter.hpp"
#include "io/exodus/mesh_slice.hpp"
#include "io/exodus/surface.hpp"
#include "io/on_root.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace {

// An edge of a face, as it travels to the rank that compares the faces at this edge.
struct FaceEdge {
  std::int64_t least, most;                      // indices of its nodes in the file
  double normal[3], inward[3], middle[3], size;  // of the face: unit, from the edge to its middle, m, m
  int block;
};

Vector vector_of(const double (&numbers)[3]) { return Eigen::Map<const Vector>(numbers); }

void put(const Vector& vector, double (&numbers)[3]) { std::copy_n(vector.data(), 3, numbers); }

// True if the two, back to back, lie over each other at their common edge. Not the faces of a crack at its tip, whose
// middles nearly coincide, nor those of a sharp rim or notch, which have an angle between them.
bool lie_over(const FaceEdge& one, const FaceEdge& other) {
  constexpr double opposite = -0.9, between = 0.05, apart = 0.1;
  const Vector normal = vector_of(one.normal), inward = vector_of(other.inward);
  return normal.dot(vector_of(other.normal)) < opposite && vector_of(one.inward).dot(inward) > 0 &&
         std::abs(normal.dot(inward)) < between &&
         (vector_of(one.middle) - vector_of(other.middle)).norm() > apart * std::max(one.size, other.size);
}

std::vector<FaceEdge> edges_of(const std::vector<Face>& faces, const MeshSlice& slice, const std::vector<int>& blocks) {
  std::vector<FaceEdge> edges;
  for (const Face& face : faces) {
    const std::span<const int> corners = face.corners();
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const int a = corners[c], b = corners[(c + 1) % corners.size()];
      const auto [least, most] = std::minmax(slice.nodes[a], slice.nodes[b]);
      FaceEdge& edge = edges.emplace_back(FaceEdge{least, most, {}, {}, {}, std::sqrt(face.area.norm()), 0});
      const Vector along = (slice.mesh.nodes[b] - slice.mesh.nodes[a]).stableNormalized();
      const Vector inward = face.middle(slice.mesh) - slice.mesh.nodes[a];
      put(face.area.stableNormalized(), edge.normal);
      put((inward - inward.dot(along) * along).stableNormalized(), edge.inward);
      put(face.middle(slice.mesh), edge.middle);
      edge.block = blocks[face.element];
    }
  }
  return edges;
}

// For each edge the block of a face that lies over its own one there, −1 if none does.
std::vector<int> blocks_over(const std::vector<FaceEdge>& edges) {
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::size_t k) { return std::tie(edges[k].least, edges[k].most); };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<int> over(edges.size(), -1);
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::find_if(begin, order.end(), [&](std::size_t k) { return key(k) != key(*begin); });
    for (auto one = begin; one != end; ++one) {
      for (auto other = begin; other != end; ++other) {
        if (lie_over(edges[*one], edges[*other])) over[*one] = edges[*other].block;
      }
    }
    begin = end;
  }
  return over;
}

// Collective. The same beside the faces of all ranks.
std::vector<int> blocks_over(const std::vector<FaceEdge>& edges, const MeshSlice& slice,
                             const Communicator& communicator) {
  std::vector<int> owners;
  for (const FaceEdge& one : edges) owners.push_back(slice_owner(slice.layout.nodes, communicator.size(), one.least));
  const Routes routes(communicator, owners);
  return routes.back(blocks_over(routes.there(edges)));
}

// The block of each element here.
std::vector<int> blocks_of(const Mesh& mesh) {
  std::vector<int> blocks;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    blocks.insert(blocks.end(), mesh.blocks[b].elements(), static_cast<int>(b));
  return blocks;
}

// Sums and minima over the pairs of blocks.
struct Pairs {
  std::size_t blocks;
  std::vector<double> counts, first;  // faces; minus the first element's number, from 1

  explicit Pairs(const MeshLayout& layout)
      : blocks(layout.blocks.size()),
        counts(blocks * blocks, 0),
        first(blocks * blocks, -static_cast<double>(layout.elements)) {}

  void add(int block, int other, std::int64_t element) {
    const std::size_t pair = static_cast<std::size_t>(block) * blocks + static_cast<std::size_t>(other);
    counts[pair] += 1;
    first[pair] = std::max(first[pair], -static_cast<double>(element));
  }

  // Collective.
  std::vector<UnmatchedFaces> found(const Communicator& communicator) {
    communicator.sum(counts);
    communicator.max(first);
    std::vector<UnmatchedFaces> all;
    for (std::size_t pair = 0; pair < counts.size(); ++pair) {
      if (counts[pair] == 0) continue;
      all.push_back({static_cast<int>(pair / blocks), static_cast<int>(pair % blocks),
                     static_cast<std::int64_t>(counts[pair]), static_cast<std::int64_t>(-first[pair])});
    }
    return all;
  }
};

// `mesh`: on rank 0.
std::vector<UnmatchedFaces> unmatched_faces(const MeshSource* mesh, const Communicator& communicator) {
  const MeshLayout layout = broadcast_layout(mesh ? mesh->layout() : MeshLayout(), communicator);
  const auto is_of_tetrahedra = [](const MeshLayout::Block& block) { return block.type == "TET4"; };
  if (std::ranges::none_of(layout.blocks, is_of_tetrahedra)) return {};
  const MeshSlice slice = slice_of_elements(mesh, layout, communicator);
  const std::vector<int> blocks = blocks_of(slice.mesh);
  const std::vector<Face> faces = surface_of(slice, communicator);
  const std::vector<int> over = blocks_over(edges_of(faces, slice, blocks), slice, communicator);
  Pairs pairs(layout);
  auto edge = over.begin();
  for (const Face& face : faces) {
    const auto end = edge + std::ssize(face.corners());
    const auto known = [](int block) { return block >= 0; };
    // The two sides of a crack, too, may have other faces, but with one common edge only.
    if (std::count_if(edge, end, known) > 1)
      pairs.add(blocks[face.element], *std::find_if(edge, end, known), slice.elements[face.element] + 1);
    edge = end;
  }
  return pairs.found(communicator);
}

}  // namespace

std::vector<UnmatchedFaces> unmatched_faces(const std::filesystem::path& file, const Communicator& communicator) {
  std::optional<MeshFile> mesh;
  run_on_root(communicator, [&] { mesh.emplace(ExodusFile::open(file)); });
  return unmatched_faces(mesh ? &*mesh : nullptr, communicator);
}

std::vector<UnmatchedFaces> unmatched_faces(const Mesh& mesh, const Communicator& communicator) {
  const MeshInMemory source(mesh);
  return unmatched_faces(&source, communicator);
}

}  // namespace strut::io
