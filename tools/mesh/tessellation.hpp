// The skeleton of an open-cell foam: the edges of a tessellation of irregular BCC seeds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut::mesh {

struct Edge {
  Vector a, b;  // its ends, m
  // Vectors of unit length across the edge, from it into the three films that meet there; zero if unknown.
  std::array<Vector, 3> films = {Vector::Zero(), Vector::Zero(), Vector::Zero()};
};

struct Skeleton {
  std::vector<Edge> edges;          // all in a box of this size at the origin, and more around it, uncut
  std::size_t cells = 0;            // number with their seed in the box
  double scatter = 0;               // standard deviation of their volumes over the mean
  Vector stretch = Vector::Ones();  // of the cells, as periods allow
};

struct FoamSeeds {
  double cell = 0;            // m, diameter of the sphere with the mean volume of a foam cell
  double irregularity = 0.5;  // 0 to 1
  std::uint64_t seed = 1;
  double sizes = 0;                 // of the spheres that the cells are drawn around: standard deviation over mean
  int relax = 0;                    // times that each seed moves to the centroid of its cell (Lloyd)
  Vector stretch = Vector::Ones();  // of the cells along x, y, z; their volume stays
  bool periodic = false;            // the box repeats
};

// Seeds are on a body-centered cubic lattice with one in the center of the box, each displaced by a random vector
// within a ball of `irregularity` (0 to 1) times half the distance of nearest neighbors, so that seeds are at least (1
// - irregularity / 2) of that distance apart. The lattice continues around the box, so that the walls have no effect,
// or repeats it: then a whole number of its cells is fitted to the box along each axis. With `sizes` the tessellation
// is Laguerre's (radical planes of spheres with a lognormal distribution), else Voronoi's.
Skeleton foam_skeleton(const Vector& size, const FoamSeeds& seeds);

// The length of the part of the edge within the box.
double length_within(const Edge& edge, const Vector& size);

}  // namespace strut::mesh
