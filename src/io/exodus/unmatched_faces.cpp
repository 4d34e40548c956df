#include "io/exodus/unmatched_faces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/parallel/gather_scatter.hpp"
#include "io/exodus/mesh_slice.hpp"
#include "io/exodus/surface.hpp"
#include "io/on_root.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace {

// A corner of a face, as it travels to the rank that compares the faces at this node.
struct FaceCorner {
  std::int64_t node;                   // its index in the file
  double inward[3], next[3], last[3];  // unit, from it: to the face's middle, and along its edges
  double normal[3], middle[3], size;   // of the face: unit, m, m
  int block;
};

Vector vector_of(const double (&numbers)[3]) { return Eigen::Map<const Vector>(numbers); }

void put(const Vector& vector, double (&numbers)[3]) { std::copy_n(vector.data(), 3, numbers); }

// True if the direction lies between the two edges.
bool holds(const FaceCorner& one, const Vector& direction) {
  constexpr double least = 0.05;
  const Vector normal = vector_of(one.normal);
  return normal.dot(vector_of(one.next).cross(direction)) > least &&
         normal.dot(direction.cross(vector_of(one.last))) > least;
}

// True if the two, back to back, lie over each other at their common corner. Not the faces of a crack at its tip, whose
// middles nearly coincide, nor those of a sharp rim or notch, which have an angle between them.
bool lie_over(const FaceCorner& one, const FaceCorner& other) {
  constexpr double opposite = -0.9, between = 0.05, apart = 0.1;
  const Vector normal = vector_of(one.normal), inward = vector_of(other.inward);
  return normal.dot(vector_of(other.normal)) < opposite && std::abs(normal.dot(inward)) < between &&
         (holds(one, inward) || holds(other, vector_of(one.inward))) &&
         (vector_of(one.middle) - vector_of(other.middle)).norm() > apart * std::max(one.size, other.size);
}

double size_of(const Face& face) { return std::sqrt(face.area.norm()); }

std::vector<FaceCorner> corners_of(const std::vector<Face>& faces, const MeshSlice& slice,
                                   const std::vector<int>& blocks) {
  std::vector<FaceCorner> all;
  for (const Face& face : faces) {
    const std::span<const int> corners = face.corners();
    const Vector middle = face.middle(slice.mesh);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const auto at = [&](std::size_t k) -> const Vector& { return slice.mesh.nodes[corners[k % corners.size()]]; };
      FaceCorner& corner = all.emplace_back();
      corner.node = slice.nodes[corners[c]];
      put(face.area.stableNormalized(), corner.normal);
      put((middle - at(c)).stableNormalized(), corner.inward);
      put((at(c + 1) - at(c)).stableNormalized(), corner.next);
      put((at(c + corners.size() - 1) - at(c)).stableNormalized(), corner.last);
      put(middle, corner.middle);
      corner.size = size_of(face);
      corner.block = blocks[face.element];
    }
  }
  return all;
}

// For each corner the block of a face that lies over its own one there, −1 if none does.
std::vector<int> blocks_over(const std::vector<FaceCorner>& corners) {
  std::vector<std::size_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0);
  const auto node = [&](std::size_t k) { return corners[k].node; };
  std::ranges::sort(order, {}, node);
  std::vector<int> over(corners.size(), -1);
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::find_if(begin, order.end(), [&](std::size_t k) { return node(k) != node(*begin); });
    for (auto one = begin; one != end; ++one) {
      for (auto other = begin; other != end; ++other) {
        if (lie_over(corners[*one], corners[*other])) over[*one] = std::max(over[*one], corners[*other].block);
      }
    }
    begin = end;
  }
  return over;
}

// Collective. The same beside the faces of all ranks.
std::vector<int> blocks_over(const std::vector<FaceCorner>& corners, const MeshSlice& slice,
                             const Communicator& communicator) {
  std::vector<int> owners;
  for (const FaceCorner& one : corners)
    owners.push_back(slice_owner(slice.layout.nodes, communicator.size(), one.node));
  const Routes routes(communicator, owners);
  return routes.back(blocks_over(routes.there(corners)));
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

// Collective. True for voxels and other hexahedra whose faces all have about one size: those of neighbors match.
bool are_squares_of_one_size(const std::vector<Face>& faces, const MeshLayout& layout,
                             const Communicator& communicator) {
  constexpr double alike = 1.2;  // a face that is halved has 1.4
  const auto is_of_tetrahedra = [](const MeshLayout::Block& block) { return block.type == "TET4"; };
  double sizes[] = {-HUGE_VAL, 0};  // the smallest one, negative; the largest
  for (const Face& face : faces)
    sizes[0] = std::max(sizes[0], -size_of(face)), sizes[1] = std::max(sizes[1], size_of(face));
  communicator.max(sizes);
  return std::ranges::none_of(layout.blocks, is_of_tetrahedra) && sizes[1] < -alike * sizes[0];
}

// `mesh`: on rank 0.
std::vector<UnmatchedFaces> unmatched_faces(const MeshSource* mesh, const Communicator& communicator) {
  const MeshLayout layout = broadcast_layout(mesh ? mesh->layout() : MeshLayout(), communicator);
  const MeshSlice slice = slice_of_elements(mesh, layout, communicator);
  const std::vector<int> blocks = blocks_of(slice.mesh);
  const std::vector<Face> faces = surface_of(slice, communicator);
  if (are_squares_of_one_size(faces, layout, communicator)) return {};
  const std::vector<int> over = blocks_over(corners_of(faces, slice, blocks), slice, communicator);
  Pairs pairs(layout);
  auto corner = over.begin();
  for (const Face& face : faces) {
    const auto end = corner + std::ssize(face.corners());
    const auto known = [](int block) { return block >= 0; };
    // The two sides of a crack, too, may have other faces, but with one common edge only.
    if (std::count_if(corner, end, known) > 2)
      pairs.add(blocks[face.element], *std::max_element(corner, end), slice.elements[face.element] + 1);
    corner = end;
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
