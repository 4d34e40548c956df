// A body of small cubes, gathered into the cells of a coarser grid: each cell knows volume, centroid, second moments
// and surface of what is in it.
#pragma once

#include <functional>
#include <vector>

#include "topology/cloud.hpp"

namespace strut::reference {

using Place = Eigen::Array3i;

// Small cubes that a body fills, those with low ≤ index < high. All sums over them are of whole and half numbers:
// exact, and the same on every machine.
struct SmallCubes {
  double edge;  // m
  Place low, high;
  std::function<bool(const Place&)> is_filled;  // false outside of low and high
};

// Sums over the small cubes of a cell, lengths in edges of a small cube, places from its grid's origin.
struct Cell {
  Place place;                              // in the coarse grid
  int cubes = 0;                            // how many
  Vector first = Vector::Zero();            // Σ x
  Tensor second = Tensor::Zero();           // Σ x xᵀ, x of the middles
  Vector surface = Vector::Zero();          // Σ n over the faces that have no cube behind them
  Tensor surface_moments = Tensor::Zero();  // Σ n ⊗ x over them, x of their middles

  void take(const Cell& other);
};

// The cells with something in them, in the order of their places, x fastest. cell_of: the cell of a small cube.
std::vector<Cell> gathered(const SmallCubes& body, const std::function<Place(const Place&)>& cell_of);

// Cells of fewer cubes than these are given to the neighbor across a face that has the most, the smallest first; those
// without a neighbor stay.
void merge_small(std::vector<Cell>& cells, int fewest);

// A unique number of a place; places from −2¹⁹ to 2¹⁹.
std::int64_t number_of(const Place& place);

// One point for each cell, without shared nodes. `edge`: of a small cube; `spacing`: of the cells, m. `at_grid`: points
// are at the place of their cell times the spacing instead of at the centroid.
PointCloud cloud_of(const std::vector<Cell>& cells, double edge, double spacing, bool at_grid);

}  // namespace strut::reference
