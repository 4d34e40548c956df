// The points of one rank, ready for mechanics: owned points and ghosts, families, halo.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "topology/cloud.hpp"
#include "topology/halo.hpp"
#include "topology/mirror.hpp"
#include "topology/neighbors/block_bonds.hpp"
#include "topology/neighbors/cracks.hpp"
#include "topology/neighbors/families.hpp"

namespace strut {

// The horizons of a block's points, over all ranks.
struct BlockHorizons {
  double smallest = 0, largest = 0;  // m; 0 if the block has no points
  double spacing = 0;                // the largest of its points, m
  int body = 0;
};

// Local indices: [0, interior) owned, all neighbors owned; [interior, owned) owned, with ghosts in the family;
// [owned, owned + ghosts) owned by other ranks, or images of points behind symmetry planes or periodic sides.
struct Domain {
  Communicator communicator;
  PointCloud cloud;  // owned points; their positions and volumes have gone to sites
  int interior = 0;
  int owned = 0;
  int ghosts = 0;
  std::vector<Site> sites;  // owned points and ghosts; at the positions that were read until a solver moves them
  std::vector<BlockHorizons> blocks;  // one per block
  Families families;
  Halo halo;
  std::vector<std::int64_t> ghost_ids;
  // Points separated by a crack: owned points, each with the id of a point to which only a crack prevents a bond;
  // ascending. The other point need not be a ghost.
  std::vector<std::pair<int, std::int64_t>> separated;
  // Symmetry planes. The mirror images of points are ghosts, with ids by Images::id.
  std::vector<Mirror> mirrors = {};
  // Periodic sides: images are ghosts, too. A domain has either these or mirrors.
  std::vector<Period> periods = {};

  Vector reference(int i) const { return sites[i].reference.head<3>().matrix(); }  // X, m
  Vector current(int i) const { return sites[i].current.head<3>().matrix(); }      // y, m
  double volume(int i) const { return sites[i].volume(); }                         // m³
  double horizon(int i) const { return sites[i].horizon(); }                       // δ, m
  int body_of(int i) const { return blocks[cloud.blocks[i]].body; }                // of an owned point
  int body_count() const {  // the largest number of a body plus one; numbers below it may be unused
    int count = 0;
    for (const BlockHorizons& block : blocks) count = std::max(count, block.body + 1);
    return count;
  }
  void stretch_sides(double t);  // periodic sides are then where they are at the time t, s
  std::int64_t id(int i) const { return i < owned ? cloud.ids[i] : ghost_ids[i - owned]; }
};

// Collective. `cloud`: after the partition. `bonds`: one for each block of the cloud; with cracks, all may lose bonds.
// Throws Error if mirrors do not meet at 180°/n.
Domain make_domain(PointCloud cloud, const std::vector<BlockBonds>& bonds, const Communicator& communicator,
                   const std::vector<Crack>& cracks = {}, std::vector<Mirror> mirrors = {},
                   std::vector<Period> periods = {});

// The stretch of the periods along x, y, z at the time t (s).
Vector stretch_at(const std::vector<Period>& periods, double t);

// Collective. The images of the bodies by periodic sides or symmetry planes, as far as they may be within `reach` (m).
// Throws Error on all ranks if mirrors make too many, of bodies that are thin beside it.
Images images_of(const Domain& domain, double reach);

// The owned points as they were read.
PointCloud whole_cloud(const Domain& domain);

// Describes the defect of a family, or returns nullptr: a shape tensor needs at least four neighbors that span space.
// `spread`: Σ V ξ⊗ξ of the family, m⁵.
const char* degeneracy(std::size_t neighbors, const Tensor& spread);

// Σ V over the family of owned point i, m³.
double family_volume(const Domain& domain, int i);

// Collective. The largest number of bonds of a point over all ranks, broken bonds included.
std::size_t largest_whole_family(const Domain& domain);

// Σ V ξ⊗ξ over its family, m⁵.
Tensor family_spread(const Domain& domain, int i);

}  // namespace strut
