#include "mechanics/off_stencil.hpp"

namespace strut {

void set_off_stencil(const Domain& domain, MaterialBlock& block) {
  block.off_stencil = {};
  if (block.lattice < 0 || domain.families.off_stencil.empty()) return;
  const ClusterLists& lists = domain.families.lists;
  for (std::size_t k = 0; k < block.points.size();) {
    if (!domain.families.is_off_stencil(block.points[k])) {
      ++k;
      continue;
    }
    const int c = lists.holding(block.points[k]);
    const Cluster cluster = lists[c];
    unsigned members = 0;
    for (; k < block.points.size() && block.points[k] <= cluster.points.back(); ++k) {
      if (!domain.families.is_off_stencil(block.points[k])) continue;
      block.off_stencil.places.push_back(static_cast<int>(k));
      members |= 1u << (block.points[k] - cluster.points[0]);
    }
    block.off_stencil.lists.append(cluster, members);
  }
}

}  // namespace strut
