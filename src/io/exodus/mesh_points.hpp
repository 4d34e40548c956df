// Makes material points from a rank's part of a mesh.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/exodus/mesh_slice.hpp"
#include "topology/cloud.hpp"
#include "topology/mirror.hpp"

namespace strut::io {

// A point for each element, at its centroid; its shared nodes and the surface of its shape are not set yet. `file`:
// name of the mesh, for errors. Throws Error on this rank: see read_exodus.
PointCloud points_at_elements(const MeshSlice& slice, const std::string& file, bool with_cells);
// `seams`: of the nodes (side_nodes.hpp).
void add_shared_nodes(const MeshSlice& slice, const std::vector<Mirror>& planes, const std::vector<std::int64_t>& seams,
                      PointCloud& cloud);
// Collective. Sets the surfaces of the shapes of those points; partial cells have their own. `apart`: see add_face.
void add_surfaces(const MeshSlice& slice, const std::vector<Mirror>& planes, const std::vector<std::int64_t>& seams,
                  const Communicator& communicator, PointCloud& cloud, FacesOnPlanes* apart);

// A point for each node of `own` that an element uses; the slice must have all elements around these nodes. `numbers`:
// of these nodes in the mesh. Throws Error on this rank: see read_exodus.
struct NodeRange {
  std::int64_t begin, end;  // indices in the file
};
PointCloud points_at_nodes(const MeshSlice& slice, const NodeRange& own, const std::vector<std::int64_t>& numbers,
                           const std::string& file, bool with_cells, const std::vector<Mirror>& planes,
                           FacesOnPlanes* apart);

// The elements whose first node is in `own`, as points at their centroids: each element once over all ranks.
PointCloud elements_of(const MeshSlice& slice, const NodeRange& own);

// The nodes of an element with `size` nodes.
template <std::size_t size>
std::array<Vector, size> corners(const Mesh& mesh, const Mesh::Block& block, std::size_t element) {
  std::array<Vector, size> nodes;
  for (std::size_t n = 0; n < size; ++n) nodes[n] = mesh.nodes[block.nodes[element * size + n]];
  return nodes;
}

// Throws Error on this rank if a hexahedron is folded at a corner.
void check_corners(const MeshSlice& slice, const std::string& file);

// Throws Error if the volume (m³) is not positive. `element`: its index in the file.
void check_volume(double volume, const Mesh::Block& block, std::int64_t element, const std::string& file);

}  // namespace strut::io
