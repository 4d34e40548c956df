#include "topology/neighbors/families.hpp"

#include <bit>

namespace strut {

std::size_t Families::bonds() const {
  std::size_t count = 0;
  for (int b = 0; b < lists.count(); ++b) {
    const Cluster cluster = lists[b];
    for (std::size_t n = 0; n < cluster.near.size(); ++n) count += std::popcount(cluster.mask[n]);
  }
  for (const LatticeFamilies& stencil : lattices) {
    if (stencil.frame().loses_bonds) continue;  // counted in the lists
    for (std::size_t i = 0; i < lattice_of.size(); ++i) {
      if (stencil.cell(static_cast<int>(i)) >= 0) count += stencil.family_size(static_cast<int>(i));
    }
  }
  return count;
}

double Families::bytes() const {
  double sum = lists.bytes();
  for (const LatticeFamilies& stencil : lattices) sum += stencil.bytes();
  return sum;
}

}  // namespace strut
