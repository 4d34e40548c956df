// A mesh in memory to material points, all of them on one rank.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"

namespace strut::io {

// A point for each element, at its centroid. `file`: the mesh's name, for errors. Throws Error: see read_exodus.
PointCloud points_at_elements(const Mesh& mesh, const std::string& file, bool with_cells);

// A point for each node that an element uses; `numbers`: the mesh's own, of all nodes. Throws Error: see read_exodus.
PointCloud points_at_nodes(const Mesh& mesh, const std::vector<std::int64_t>& numbers, const std::string& file,
                           bool with_cells);

// Bit k of a node: it is in set k.
std::vector<std::uint64_t> sets_of_nodes(const Mesh& mesh);

// The nodes of an element of `size` nodes.
template <std::size_t size>
std::array<Vector, size> corners(const Mesh& mesh, const Mesh::Block& block, std::size_t element) {
  std::array<Vector, size> nodes;
  for (std::size_t n = 0; n < size; ++n) nodes[n] = mesh.nodes[block.nodes[element * size + n]];
  return nodes;
}

// Throws Error where the volume (m³) is not positive. `number`: the element's place in the file, from 1.
void check_volume(double volume, const Mesh::Block& block, std::size_t number, const std::string& file);

}  // namespace strut::io
