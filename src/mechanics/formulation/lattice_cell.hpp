// The cell of a point on a lattice by quadratic correspondence (quadratic_fit.hpp), for any set of bonds.
#pragma once

#include <array>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut {

struct FitBond {
  Vector xi;      // m
  double weight;  // ω V, m³
};

// Weights of the far ends of a point's bonds in F at the integration points of its cell, ∂F_rb/∂y_jr, 1/m; and its
// steepness times its volume, 1/m². No bonds if the point carries no stress.
struct CellWeights {
  std::vector<std::array<Vector, 4>> bonds;
  double steepness = 0;
};

// The weights of a cubic cell of edge `spacing` (m), without correction at surfaces.
CellWeights lattice_cell(double spacing, const std::vector<FitBond>& family);

}  // namespace strut
