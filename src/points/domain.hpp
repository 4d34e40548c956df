// The points of one rank ready for mechanics: owned points and ghosts, families, halo.
#pragma once

#include <functional>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "points/cloud.hpp"
#include "points/halo.hpp"
#include "points/neighbors/families.hpp"
#include "points/site.hpp"

namespace strut {

// What the families of a body become: a stencil where its points sit on a lattice and that is faster; or what is asked
// for. Lists are for those who read them; a body of blocks that want different ones has lists.
enum class FamilyKind { fastest, stencil, lists };

// How the points of a block are bonded: their horizon δ, and the body they belong to. Bodies are not bonded to each
// other.
struct BlockBonds {
  BlockBonds(double horizon, int body = 0) : horizon(horizon), body(body) {}
  static BlockBonds per_spacing(double factor, int body = 0) {
    BlockBonds bonds(factor, body);
    bonds.in_spacings = true;
    return bonds;
  }

  double horizon;  // of all points, m; or in local spacings of each
  bool in_spacings = false;
  int body;
  FamilyKind families = FamilyKind::fastest;
  // Bonds run through material: a bond whose ends are not joined by points that touch (PointCloud::joints), all of them
  // within the horizon of both ends, is left out. Needs joints, and lists. Of two blocks, one that asks is enough.
  bool through_material = false;
  // Families are of those that touch, whatever their distance: at a centroid or a node a cell does not show how far it
  // reaches. Needs joints, and lists. Of two blocks, one that asks is enough.
  bool touching = false;

  // δ of a point with this local spacing, m.
  double horizon_at(double spacing) const { return in_spacings ? horizon * spacing : horizon; }
  // Those that touch are looked for within so many horizons: the middles of cells that share a corner, or have taken
  // over what is in a neighbor, are up to 2.8 spacings apart.
  double search_factor() const { return touching ? 1.6 : 1; }
};

// Whether two points of one body, with these horizons (m) and the bond ξ, are in each other's families:
// |ξ| ≤ (δ_i + δ_j)/2, which is symmetric.
bool bonded(double one_horizon, double other_horizon, const Vector& xi);

// What the horizons of a block's points turned out to be, over all ranks.
struct BlockHorizons {
  double smallest = 0, largest = 0;  // m; 0 where the block has no points
  double spacing = 0;                // of the points, the largest, m
  int body = 0;
};

// Local indices: [0, interior) owned, all neighbors owned; [interior, owned) owned, with ghosts in the family;
// [owned, owned + ghosts) owned by other ranks.
struct Domain {
  Communicator communicator;
  PointCloud cloud;  // owned points; their positions and volumes have gone to sites
  int interior = 0;
  int owned = 0;
  int ghosts = 0;
  std::vector<Site> sites;  // owned points and ghosts; they stand where they were read until a solver moves them
  std::vector<BlockHorizons> blocks;  // one each
  Families families;
  Halo halo;

  Vector reference(int i) const { return sites[i].reference.head<3>().matrix(); }  // X, m
  Vector current(int i) const { return sites[i].current.head<3>().matrix(); }      // y, m
  double volume(int i) const { return sites[i].reference[3]; }                     // m³
  double horizon(int i) const { return sites[i].current[3]; }                      // δ, m
};

// Collective. `cloud`: as partitioned. `bonds`: one for each block of the cloud.
Domain make_domain(PointCloud cloud, const std::vector<BlockBonds>& bonds, const Communicator& communicator);

// The owned points as they were read.
PointCloud whole_cloud(const Domain& domain);

// What a step takes of a point of each block for its bonds, in ns, roughly; whether any are summed by stencils.
struct BondCosts {
  std::vector<double> of_block;
  bool by_stencils = false;
};

// Collective, for a partition. `spacings`: the mean one of each block, m; 0 where it has no points.
BondCosts bond_costs(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const std::vector<double>& spacings,
                     const Communicator& communicator);

// What is wrong with a family, or nullptr: a shape tensor needs at least four neighbors that span space.
// `spread`: Σ V ξ⊗ξ of the family.
const char* degeneracy(std::size_t neighbors, const Tensor& spread);

// Σ V ξ⊗ξ over the family of owned point i, m⁵.
Tensor family_spread(const Domain& domain, int i);

}  // namespace strut
