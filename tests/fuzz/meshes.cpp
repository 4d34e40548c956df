#include "meshes.hpp"

namespace strut::fuzz {

namespace {

constexpr int across = 3, layers = 4;

int node(int i, int j, int k) { return (k * (across + 1) + j) * (across + 1) + i; }

}  // namespace

void add_box(io::Mesh& mesh, const std::string& block, double spacing, double z, const std::vector<std::string>& sets) {
  const int first = static_cast<int>(mesh.nodes.size());
  for (int k = 0; k <= layers; ++k) {
    for (int j = 0; j <= across; ++j) {
      for (int i = 0; i <= across; ++i) mesh.nodes.push_back(spacing * Vector(i, j, k) + Vector(0, 0, z));
    }
  }
  io::Mesh::Block& box = mesh.blocks.emplace_back(io::Mesh::Block{block, "HEX8", {}, {}});
  for (int cell = 0; cell < across * across * layers; ++cell) {
    const int i = cell % across, j = cell / across % across, k = cell / across / across;
    for (const int level : {k, k + 1}) {
      for (const int corner :
           {node(i, j, level), node(i + 1, j, level), node(i + 1, j + 1, level), node(i, j + 1, level)}) {
        box.nodes.push_back(first + corner);
      }
    }
  }
  if (mesh.node_sets.empty()) {
    for (const std::string& set : sets) mesh.node_sets.push_back({set, {}});
  }
  for (io::Mesh::NodeSet& set : mesh.node_sets) {
    for (int n = 0; n < node(0, 0, 1); ++n) set.nodes.push_back(first + n);
  }
}

io::Mesh tetrahedra() {
  io::Mesh mesh;
  for (int n = 0; n < 8; ++n) mesh.nodes.emplace_back(n & 1, n >> 1 & 1, n >> 2 & 1);
  mesh.blocks.push_back({"", "TET4", {0, 1, 2, 4, 7, 5, 6, 3}, {}});
  mesh.node_sets.push_back({"", {0, 1, 2}});
  return mesh;
}

io::Mesh spheres() {
  io::Mesh mesh;
  mesh.blocks.push_back({"points", "SPHERE", {}, {}});
  for (int n = 0; n < 12; ++n) {
    mesh.nodes.emplace_back(n, 0, 0);
    mesh.blocks[0].nodes.push_back(n);
    mesh.blocks[0].volumes.push_back(1);
  }
  return mesh;
}

}  // namespace strut::fuzz
