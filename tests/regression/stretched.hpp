// Lattices whose cells are no cubes, and turned ones.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "base/errors.hpp"
#include "io/exodus/exodus.hpp"
#include "regression/bodies.hpp"

namespace strut::regression {

// Writes the lattice as the folder's mesh, its places multiplied by `factors`, then turned.
inline void write_stretched(const RunFolder& folder, const Lattice& lattice, const Vector& factors,
                            const Tensor& turn = Tensor::Identity()) {
  io::Mesh mesh = lattice.mesh();
  for (Vector& node : mesh.nodes) node = turn * node.cwiseProduct(factors);
  run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
}

inline Tensor turned_by(double degrees, const Vector& axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
}

using Tetrahedra = std::vector<std::array<int, 4>>;  // corners in a hexahedron
// Six around one diagonal, the same on opposite faces.
inline const Tetrahedra around_diagonal{{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                        {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
// Five, which halve opposite faces along crossed diagonals: faces of neighbors do not match.
inline const Tetrahedra at_corners{{0, 1, 3, 4}, {1, 2, 3, 6}, {1, 4, 5, 6}, {3, 4, 6, 7}, {1, 3, 4, 6}};

inline io::Mesh in_tetrahedra(io::Mesh mesh, const Tetrahedra& corners = around_diagonal) {
  for (io::Mesh::Block& block : mesh.blocks) {
    std::vector<int> nodes;
    for (std::size_t e = 0; e < block.elements(); ++e) {
      for (const auto& tetrahedron : corners) {
        for (const int corner : tetrahedron) nodes.push_back(block.nodes[8 * e + corner]);
      }
    }
    block.type = "TET4", block.nodes = nodes;
  }
  return mesh;
}

}  // namespace strut::regression
