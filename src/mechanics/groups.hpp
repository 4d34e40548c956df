// Points of a block that are taken side by side, one a lane, and the sums over their families: by the list of their
// bundle, or by the sums over their lattice.
#pragma once

#include <array>
#include <optional>

#include "mechanics/bonds.hpp"
#include "mechanics/lattice_sums.hpp"

namespace strut {

enum class Part { interior, boundary };  // the points that need no ghost; the others

// Sums over lattices are of all points at once, after the exchange: their points are all in the second part.
inline std::pair<int, int> range(const MaterialBlock& block, Part part) {
  if (block.lattice >= 0) return {0, part == Part::interior ? 0 : static_cast<int>(block.points.size())};
  if (part == Part::interior) return {0, block.interior};
  return {block.interior, static_cast<int>(block.points.size())};
}

struct Group {
  static constexpr int width = Bundle::width;

  std::array<int, width> k;       // places in block.points; the last one stands in for those that are missing
  int count;                      // of those that are there
  std::optional<Bundle> bundle;  // none on a lattice
};

// Some points of a block, with lists of their own.
struct Chosen {
  std::vector<int> places;  // in block.points
  Bundles lists;
};

// Points of a block, in groups.
class Groups {
 public:
  Groups(const Body& body, const MaterialBlock& block, Part part) : begin_(range(block, part).first) {
    const int end = range(block, part).second;
    points_ = end - begin_;
    if (block.lattice >= 0 || points_ == 0) return;
    lists_ = &body.domain.families.lists;
    first_ = lists_->holding(block.points[begin_]);
    count_ = lists_->holding(block.points[end - 1]) + 1 - first_;
    first_point_ = block.points[begin_];
  }
  explicit Groups(const Chosen& chosen)
      : points_(static_cast<int>(chosen.places.size())),
        lists_(&chosen.lists),
        count_(chosen.lists.count()),
        chosen_(&chosen.places) {}

  int count() const { return lists_ ? count_ : (points_ + Group::width - 1) / Group::width; }
  Group operator[](int g) const {
    std::optional<Bundle> bundle;
    if (lists_) bundle = (*lists_)[first_ + g];
    int at = Group::width * g;  // among the points of these groups
    if (bundle && !chosen_) at = bundle->points[0] - first_point_;
    const int count = bundle ? static_cast<int>(bundle->points.size()) : std::min(Group::width, points_ - at);
    Group group{{}, count, bundle};
    for (int l = 0; l < Group::width; ++l) {
      const int place = at + std::min(l, count - 1);
      group.k[l] = chosen_ ? (*chosen_)[place] : begin_ + place;
    }
    return group;
  }

 private:
  int begin_ = 0, points_ = 0;
  const Bundles* lists_ = nullptr;
  int first_ = 0, count_ = 0, first_point_ = 0;
  const std::vector<int>* chosen_ = nullptr;
};

// The lanes of a group by of(lane).
template <class Of>
small::Vector3<small::Lanes> vectors(const Group& group, Of of) {
  small::Vector3<small::Lanes> result = bonds::zero_vector<small::Lanes>();
  for (int l = 0; l < group.count; ++l) {
    const Vector v = of(l);
    for (int c = 0; c < 3; ++c) result.c[c][l] = v[c];
  }
  return result;
}
template <class Of>
small::Tensor3<small::Lanes> tensors(const Group& group, Of of) {
  small::Tensor3<small::Lanes> result = bonds::zero_tensor<small::Lanes>();
  for (int l = 0; l < group.count; ++l) {
    const Tensor t = of(l);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) result.c[i][j][l] = t(i, j);
    }
  }
  return result;
}

// δF of a field, or F of the places; of F on a lattice without the identity: there, Σ ω V_j (u_j − u_i) ⊗ ξ is summed.
template <class Weight>
small::Tensor3<small::Lanes> moments(const Body& body, const MaterialBlock& block, const Group& group,
                                     const Displacements& u, Weight weight) {
  if (group.bundle) return bonds::gather(bonds::OfBundle{*group.bundle}, u.sites, weight);
  const LatticeSums& sums = *body.lattice_sums[block.lattice];
  return tensors(group, [&](int l) { return sums.moment(block.points[group.k[l]], u); });
}

}  // namespace strut
