// The nodes of elements, which tell what the mesh joins: bonds join more.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/domain.hpp"

namespace strut {

class MeshNodes {
 public:
  // Collective.
  explicit MeshNodes(const Domain& domain);

  bool any() const { return any_; }  // the same on all ranks
  bool of_both(int i, int j) const { return any_ && nodes_[0][i] != none && nodes_[0][j] != none; }
  // True if the two points have a node in common, or if it is unknown: for spheres, and images behind planes and sides.
  bool may_join(int i, int j) const;

  // Collective. For each owned point, the least id of the points that elements with common nodes join to it.
  std::vector<std::int64_t> parts(const Domain& domain) const;

 private:
  static constexpr std::int64_t none = -1;
  bool has(int i, std::int64_t node) const;

  bool any_ = false;
  std::array<std::vector<std::int64_t>, 8> nodes_;  // of owned points and ghosts; none after the last
  std::vector<std::uint8_t> is_image_;
};

}  // namespace strut
