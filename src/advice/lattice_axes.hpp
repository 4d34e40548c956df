// The axes of the lattice on which points stand, which turn with a body.
#pragma once

#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// The directions from an owned point to its nearest neighbors, columns of unit length: to the nearest one, to the
// nearest one off that line, and to the nearest one off their plane; without any the third stands on the plane. Zero
// where all neighbors stand on one line.
Tensor lattice_axes(const Domain& domain, int i);

// Collective. For each block the mean of how many times as long the longest of the vectors to these three neighbors is
// as the least distance of layers that they make: 1 for cubes, 2 for cells twice as long as wide. The mean is that of
// points of an ordinary solid with whole cells, all their bonds and three such neighbors; 0 without any.
std::vector<double> unevenness_of_lattices(const Body& body);
constexpr double uneven_from = 1.1;

}  // namespace strut
