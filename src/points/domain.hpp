// The points of one rank ready for mechanics: owned points and ghosts, families, halo.
#pragma once

#include <functional>
#include <vector>

#include "base/communicator.hpp"
#include "points/cloud.hpp"
#include "points/halo.hpp"

namespace strut {

// Who is within the horizon: for owned point i, neighbours[start[i]] … neighbours[start[i + 1] − 1], local indices of
// owned or ghost points, ordered by global id so that every sum over a family is the same on any number of ranks.
struct Families {
  std::vector<std::size_t> start{0};
  std::vector<int> neighbours;

  std::size_t size(int i) const { return start[i + 1] - start[i]; }
  std::size_t bonds() const { return neighbours.size(); }
};

// How the points of a block are bonded: δ (m), and the body they belong to. Bodies are not bonded to each other.
struct BlockBonds {
  BlockBonds(double horizon, int body = 0) : horizon(horizon), body(body) {}
  double horizon;
  int body;
};

// Whether two points with the bond ξ are in each other's families: |ξ| ≤ (δ_i + δ_j)/2, which is symmetric.
bool bonded(const BlockBonds& one, const BlockBonds& other, const Vector& xi);

// Local indices: [0, interior) owned, all neighbours owned; [interior, owned) owned, with ghosts in the family;
// [owned, owned + ghosts) owned by other ranks.
struct Domain {
  Communicator communicator;
  PointCloud cloud;  // owned points
  int interior = 0;
  int owned = 0;
  int ghosts = 0;
  // Owned points and ghosts.
  std::vector<Vector> positions;  // m
  std::vector<double> volumes;    // m³
  std::vector<double> horizons;   // m
  std::vector<BlockBonds> bonds;  // of each block
  Families families;
  Halo halo;
};

// Collective. `cloud`: as partitioned. `bonds`: one for each block of the cloud.
Domain make_domain(PointCloud cloud, const std::vector<BlockBonds>& bonds, const Communicator& communicator);

// What is wrong with a family, or nullptr: a shape tensor needs at least four neighbours that span space.
// `spread`: Σ V ξ⊗ξ of the family.
const char* degeneracy(std::size_t neighbours, const Tensor& spread);

// Σ V ξ⊗ξ over the family of owned point i, m⁵.
Tensor family_spread(const Domain& domain, int i);

}  // namespace strut
