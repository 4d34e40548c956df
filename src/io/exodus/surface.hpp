// The surface of a mesh: the faces that belong to only one element.
#pragma once

#include <span>
#include <vector>

#include "io/exodus/mesh_slice.hpp"
#include "topology/mirror.hpp"

namespace strut::io {

// The corners of the sides of a HEX8 or TET4, outward by the right-hand rule; the last one −1 of a triangle.
std::span<const int[4]> sides_of(const std::string& type);

struct Face {
  int nodes[4];              // the last one −1 for a triangle
  std::int64_t element = 0;  // counted over all blocks of the mesh here, from 0
  Vector area;               // ∫ n dA, n outward, m²

  std::span<const int> corners() const { return {nodes, nodes[3] < 0 ? 3u : 4u}; }
  Vector middle(const Mesh& mesh) const;  // the mean of the corners
  // The mean of corner c, the middles of its two edges and the middle of the face: the center of the corner's part.
  Vector middle_at(const Mesh& mesh, std::size_t c) const;
};

// True if it lies on the plane, or side.
bool is_on(const Mirror& plane, const Face& face, const Mesh& mesh);
// The bits (Mirror::bit) of the symmetry planes that it lies on; sides do not count.
std::uint32_t planes_of(const std::vector<Mirror>& planes, const Face& face, const Mesh& mesh);

// The surface faces of hexahedra and tetrahedra, in an order that depends only on the mesh. The first function takes
// the elements on this rank for the whole mesh; the second, collective, returns the faces of the whole mesh that belong
// to elements on this rank.
std::vector<Face> surface_of(const Mesh& mesh);
std::vector<Face> surface_of(const MeshSlice& slice, const Communicator& communicator);

}  // namespace strut::io
