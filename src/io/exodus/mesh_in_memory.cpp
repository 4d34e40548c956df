// Serves a mesh in memory like that of a file.
#include <algorithm>
#include <numeric>

#include "io/exodus/mesh_read.hpp"

namespace strut::io {

MeshInMemory::MeshInMemory(const Mesh& mesh) : mesh_(mesh) {
  layout_.nodes = std::ssize(mesh.nodes);
  for (const Mesh::Block& block : mesh.blocks) {
    layout_.blocks.push_back(
        {block.name, block.type, static_cast<std::int64_t>(block.elements()), !block.cells.empty()});
    layout_.elements += layout_.blocks.back().elements;
  }
  for (const Mesh::NodeSet& set : mesh.node_sets) layout_.node_sets.push_back({set.name, std::ssize(set.nodes)});
}

void MeshInMemory::places(std::int64_t begin, std::span<Place> values) const {
  for (std::size_t n = 0; n < values.size(); ++n) {
    const Vector& node = mesh_.nodes[static_cast<std::size_t>(begin) + n];
    values[n] = {node[0], node[1], node[2]};
  }
}

void MeshInMemory::nodes_of_set(std::size_t set, std::int64_t begin, std::span<int> nodes) const {
  std::copy_n(mesh_.node_sets[set].nodes.begin() + begin, nodes.size(), nodes.begin());
}

void MeshInMemory::nodes_of_block(std::size_t block, std::int64_t begin, std::span<int> nodes) const {
  std::copy_n(mesh_.blocks[block].nodes.begin() + begin, nodes.size(), nodes.begin());
}

void MeshInMemory::sphere_volumes(std::size_t block, std::int64_t begin, std::span<double> values) const {
  std::copy_n(mesh_.blocks[block].volumes.begin() + begin, values.size(), values.begin());
}

void MeshInMemory::cell_attribute(std::size_t block, std::size_t attribute, std::int64_t begin,
                                  std::span<double> values) const {
  for (std::size_t e = 0; e < values.size(); ++e) {
    PartialCell cell = mesh_.blocks[block].cells[static_cast<std::size_t>(begin) + e];
    values[e] = member(cell, attribute);
  }
}

void MeshInMemory::numbers(On, std::int64_t begin, std::span<std::int64_t> values) const {
  std::iota(values.begin(), values.end(), begin + 1);
}

}  // namespace strut::io
