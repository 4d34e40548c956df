// Meshes of bricks, for tests.
#pragma once

#include <vector>

#include "io/exodus/exodus.hpp"

namespace strut::io {

// Hexahedra between planes at x, y, z. Node sets "zmin" and "edge" (the first line of nodes along x).
inline Mesh bricks(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z) {
  Mesh mesh;
  for (const double c : z) {
    for (const double b : y) {
      for (const double a : x) mesh.nodes.emplace_back(a, b, c);
    }
  }
  const int nx = static_cast<int>(x.size()), ny = static_cast<int>(y.size()), nz = static_cast<int>(z.size());
  const auto node = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
  Mesh::Block block{"bricks", "HEX8", {}, {}};
  for (int k = 0; k + 1 < nz; ++k) {
    for (int j = 0; j + 1 < ny; ++j) {
      for (int i = 0; i + 1 < nx; ++i) {
        for (const int l : {k, k + 1}) {
          for (const int n : {node(i, j, l), node(i + 1, j, l), node(i + 1, j + 1, l), node(i, j + 1, l)}) {
            block.nodes.push_back(n);
          }
        }
      }
    }
  }
  mesh.blocks.push_back(block);
  mesh.node_sets = {{"zmin", {}}, {"edge", {}}};
  for (int n = 0; n < nx * ny; ++n) mesh.node_sets[0].nodes.push_back(n);
  for (int n = 0; n < nx; ++n) mesh.node_sets[1].nodes.push_back(n);
  return mesh;
}

// Each brick as six tetrahedra around its diagonal from corner 0 to corner 6.
inline Mesh as_tetrahedra(Mesh mesh) {
  constexpr int around[7] = {1, 2, 3, 7, 4, 5, 1};
  std::vector<int> nodes;
  for (std::size_t e = 0; e < mesh.blocks[0].elements(); ++e) {
    const int* corner = &mesh.blocks[0].nodes[8 * e];
    for (int k = 0; k < 6; ++k) {
      nodes.insert(nodes.end(), {corner[0], corner[around[k]], corner[around[k + 1]], corner[6]});
    }
  }
  mesh.blocks[0] = {"tetrahedra", "TET4", nodes, {}};
  return mesh;
}

}  // namespace strut::io
