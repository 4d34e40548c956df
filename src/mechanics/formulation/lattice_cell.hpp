// The cell of a point in a lattice by quadratic correspondence (quadratic_fit.hpp), whatever bonds it has.
#pragma once

#include <array>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut {

struct FitBond {
  Vector xi;      // m
  double weight;  // ω V, m³
};

// What the far ends of a point's bonds give to F at the places of its cell: ∂F_rb/∂y_jr, of each place, 1/m; and its
// steepness times its volume, 1/m². Without bonds where the point carries no stress.
struct CellWeights {
  std::vector<std::array<Vector, 4>> bonds;
  double steepness = 0;
};

// Of a cubic cell, without correction at surfaces.
CellWeights lattice_cell(double spacing, const std::vector<FitBond>& family);

}  // namespace strut
