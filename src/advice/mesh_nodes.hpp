// The nodes of elements, or the elements around nodes, which tell what the mesh joins: bonds join more.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/domain.hpp"

namespace strut {

class MeshNodes {
 public:
  // Collective.
  explicit MeshNodes(const Domain& domain);

  bool any() const { return !nodes_.empty(); }  // the same on all ranks
  bool of_both(int i, int j) const { return any() && nodes_[0][i] != none && nodes_[0][j] != none; }
  // True if the two points have a node (element) in common, or if it is unknown: for spheres, and images behind planes
  // and sides.
  bool may_join(int i, int j) const;

  // Collective. For each owned point, the least id of the points that common nodes join to it.
  std::vector<std::int64_t> parts(const Domain& domain) const;

 private:
  static constexpr std::int64_t none = -1;
  bool has(int i, std::int64_t node) const;

  std::vector<std::vector<std::int64_t>> nodes_;  // columns: of owned points and ghosts; none after the last
  std::vector<std::uint8_t> is_image_;
};

}  // namespace strut
