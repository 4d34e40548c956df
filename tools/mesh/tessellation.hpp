// The skeleton of an open-cell foam: the edges of a Voronoi tessellation of irregular BCC seeds.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut::mesh {

struct Edge {
  Vector a, b;  // its ends, m
};

struct Skeleton {
  std::vector<Edge> edges;  // all in a box of this size at the origin, and more around it, uncut
  std::size_t cells = 0;    // number with their seed in the box
};

// Seeds are on a body-centered cubic lattice with one in the center of the box, each displaced by a random vector
// within a ball of `irregularity` (0 to 1) times half the distance of nearest neighbors, so that seeds are at least (1
// - irregularity / 2) of that distance apart. The lattice continues around the box, so that the walls have no effect.
// `cell`: diameter (m) of the sphere with the mean volume of a foam cell.
Skeleton foam_skeleton(const Vector& size, double cell, double irregularity, std::uint64_t seed);

// The length of the part of the edge within the box.
double length_within(const Edge& edge, const Vector& size);

}  // namespace strut::mesh
