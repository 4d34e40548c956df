// Bodies on a lattice that are summed by a stencil instead of lists.
#pragma once

#include <vector>

#include "topology/neighbors/lattice.hpp"
#include "topology/neighbors/search.hpp"

namespace strut {

// The bodies on a lattice, over the pool: which member is in which cell, until points have their order in memory.
struct Stencils {
  std::vector<LatticeFamilies> lattices;
  std::vector<int> of;  // of pool members; −1: lists

  bool is_listed(int i) const { return of[i] < 0 || lattices[of[i]].frame().loses_bonds; }
};

Stencils stencils_of(const std::vector<LatticeFrame>& frames, const std::vector<Vector>& positions,
                     const std::vector<int>& bodies, int owned);

// Collective. The lattices of `found` on which the images of their points lie, too, extended to hold these images;
// without lattices on which an image has the cell of a point.
std::vector<LatticeFrame> frames_with_images(const std::vector<LatticeFrame>& found, const CandidatePool& pool,
                                             int owned, const Mirrored& mirrored, const Communicator& communicator);

// Collective. Lattices that are faster than lists, or asked for.
std::vector<LatticeFrame> chosen_frames(const std::vector<LatticeFrame>& found, const Stencils& stencils,
                                        const CandidatePool& pool, int owned, const Communicator& communicator);

// Calls visit(j) for the family of owned point i, by its stencil or by a search.
template <class Visit>
void for_each_neighbor(const Stencils& stencils, const Search& search, const CandidatePool& pool, int i,
                       Visit&& visit) {
  if (stencils.of[i] >= 0) {
    stencils.lattices[stencils.of[i]].for_each(i, visit);
  } else {
    for_each_neighbor(search, pool, i, visit);
  }
}

// Approximate time of a step for the bonds of a point, ns, in each block; whether stencils sum the bonds of any block.
struct BondCosts {
  std::vector<double> of_block;
  bool by_stencils = false;
};

// Collective, for a partition. `spacings`: mean spacing of each block, m; 0 if it has no points.
BondCosts bond_costs(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const std::vector<double>& spacings,
                     const Communicator& communicator);

}  // namespace strut
