// The skeleton of an open-cell foam: the edges of a Voronoi tessellation of disturbed BCC seeds.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut::mesh {

struct Edge {
  Vector a, b;  // its ends, m
};

struct Skeleton {
  std::vector<Edge> edges;  // all that a box of the size at the origin holds, and more around it; none is cut
  std::size_t cells = 0;    // whose seed lies in the box
};

// Seeds on a body-centered cubic lattice, one of them in the middle of the box, each moved by a random vector within a
// ball of `irregularity` (0 to 1) times half the distance of neighbors, so that no two come closer than
// (1 - irregularity / 2) of that distance. The lattice goes on around the box: nothing in the box knows of its walls.
// `cell`: diameter (m) of the sphere that has the mean volume of a cell.
Skeleton foam_skeleton(const Vector& size, double cell, double irregularity, std::uint64_t seed);

// The length of the part of the edge within the box.
double length_within(const Edge& edge, const Vector& size);

}  // namespace strut::mesh
