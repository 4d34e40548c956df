// Lattices whose cells are no cubes.
#pragma once

#include "base/errors.hpp"
#include "io/exodus/exodus.hpp"
#include "regression/bodies.hpp"

namespace strut::regression {

// Writes the lattice as the folder's mesh, its places multiplied by `factors`.
inline void write_stretched(const RunFolder& folder, const Lattice& lattice, const Vector& factors) {
  io::Mesh mesh = lattice.mesh();
  for (Vector& node : mesh.nodes) node = node.cwiseProduct(factors);
  run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
}

}  // namespace strut::regression
