// The part of a mesh that a rank has, to material points.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/exodus/mesh_slice.hpp"
#include "topology/mirror.hpp"

namespace strut::io {

// A point for each element, at its centroid; their surfaces are missing yet. `file`: the mesh's name, for errors.
// Throws Error on this rank: see read_exodus.
PointCloud points_at_elements(const MeshSlice& slice, const std::string& file, bool with_cells,
                              const std::vector<Mirror>& planes);
// Collective. The surfaces of the shapes of those points, but of cells, which bring their own.
void add_surfaces(const MeshSlice& slice, const std::vector<Mirror>& planes, const Communicator& communicator,
                  PointCloud& cloud);

// A point for each node of `own` that an element uses: nodes around which the slice has all elements. `numbers`: the
// mesh's own, of these. Throws Error on this rank: see read_exodus.
struct NodeRange {
  std::int64_t begin, end;  // places in the file
};
PointCloud points_at_nodes(const MeshSlice& slice, const NodeRange& own, const std::vector<std::int64_t>& numbers,
                           const std::string& file, bool with_cells, const std::vector<Mirror>& planes);

// The elements whose first node is of `own`, as points at their centroids: of all ranks each once.
PointCloud elements_of(const MeshSlice& slice, const NodeRange& own);

// The nodes of an element of `size` nodes.
template <std::size_t size>
std::array<Vector, size> corners(const Mesh& mesh, const Mesh::Block& block, std::size_t element) {
  std::array<Vector, size> nodes;
  for (std::size_t n = 0; n < size; ++n) nodes[n] = mesh.nodes[block.nodes[element * size + n]];
  return nodes;
}

// Throws Error on this rank: a hexahedron is folded at a corner.
void check_corners(const MeshSlice& slice, const std::string& file);

// Throws Error where the volume (m³) is not positive. `element`: its place in the file.
void check_volume(double volume, const Mesh::Block& block, std::int64_t element, const std::string& file);

}  // namespace strut::io
