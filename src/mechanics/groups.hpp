// Points of a block that are taken side by side, one a lane, and the sums over their families: by the list of their
// bundle, or by the sums over their lattice.
#pragma once

#include <array>
#include <optional>

#include "mechanics/bonds.hpp"
#include "mechanics/lattice_sums.hpp"

namespace strut {

enum class Part { interior, boundary };  // the points that need no ghost; the others

inline std::pair<int, int> range(const MaterialBlock& block, Part part) {
  if (part == Part::interior) return {0, block.interior};
  return {block.interior, static_cast<int>(block.points.size())};
}

struct Group {
  static constexpr int width = Bundle::width;

  std::array<int, width> k;  // places in block.points; the last one stands in for those that are missing
  int count;                 // of those that are there
  // Where their sums come from, one of both.
  std::optional<Bundle> bundle;
  const LatticeSums::Chunk* chunk;
};

// Some points of a block, with lists of their own.
struct Chosen {
  std::vector<int> places;  // in block.points
  Bundles lists;
};

// Points of a block, in groups.
class Groups {
 public:
  // Those of a part, of a block that has lists.
  Groups(const Body& body, const MaterialBlock& block, Part part) : runs_{range(block, part), {}} {
    const auto [begin, end] = runs_[0];
    if (begin == end) return;
    lists_ = &body.domain.families.lists;
    first_ = lists_->holding(block.points[begin]);
    count_ = lists_->holding(block.points[end - 1]) + 1 - first_;
    first_point_ = block.points[begin];
  }
  // Those in some slots of a lattice.
  Groups(const MaterialBlock& block, const LatticeSums::Chunk& chunk)
      : runs_{part_of(block, chunk, Part::interior), part_of(block, chunk, Part::boundary)}, chunk_(&chunk) {
    count_ = groups_in(0) + groups_in(1);
  }
  explicit Groups(const Chosen& chosen)
      : runs_{std::pair(0, static_cast<int>(chosen.places.size())), {}},
        lists_(&chosen.lists),
        count_(chosen.lists.count()),
        chosen_(&chosen.places) {}

  int count() const { return count_; }
  Group operator[](int g) const {
    if (chunk_) {
      const int run = g < groups_in(0) ? 0 : 1,
                at = runs_[run].first + Group::width * (run == 0 ? g : g - groups_in(0));
      return group(at, std::min(Group::width, runs_[run].second - at), {});
    }
    const Bundle bundle = (*lists_)[first_ + g];
    const int at = chosen_ ? Group::width * g : runs_[0].first + bundle.points[0] - first_point_;
    return group(at, static_cast<int>(bundle.points.size()), bundle);
  }

 private:
  static std::pair<int, int> part_of(const MaterialBlock& block, const LatticeSums::Chunk& chunk, Part part) {
    const auto [begin, end] = range(block, part);
    return chunk.part_of(block.points, begin, end);
  }
  int groups_in(int run) const { return (runs_[run].second - runs_[run].first + Group::width - 1) / Group::width; }
  Group group(int at, int count, std::optional<Bundle> bundle) const {
    Group group{{}, count, bundle, chunk_};
    for (int l = 0; l < Group::width; ++l) {
      const int place = at + std::min(l, count - 1);
      group.k[l] = chosen_ ? (*chosen_)[place] : place;
    }
    return group;
  }

  std::array<std::pair<int, int>, 2> runs_;  // of places in block.points
  const Bundles* lists_ = nullptr;
  int first_ = 0, count_ = 0, first_point_ = 0;
  const LatticeSums::Chunk* chunk_ = nullptr;
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

// ---- Sums over the families of a group, of places y or of a field in their stead -----------------------------------

// Σ ω V_j (v_j − v_i) ⊗ ξ of places or of a field v: F K. In a chunk of a lattice, of the places without the identity.
template <class Weight>
small::Tensor3<small::Lanes> moments(const MaterialBlock& block, const Group& group, const Displacements& u,
                                     Weight weight) {
  if (group.bundle) return bonds::gather(bonds::OfBundle{*group.bundle}, u.sites, weight);
  return tensors(group, [&](int l) { return group.chunk->moment(block.points[group.k[l]], u); });
}

// The mean gradient's residual.
template <class Weight>
bonds::Residual<small::Lanes> residuals(const MaterialBlock& block, const Group& group, const Site* places,
                                        const std::vector<ForceState>& gradients, Weight weight) {
  if (group.bundle) return bonds::residual(bonds::OfBundle{*group.bundle}, places, gradients.data(), weight);
  return {vectors(group, [&](int l) { return group.chunk->residual_force(block.points[group.k[l]]); }),
          tensors(group, [&](int l) { return group.chunk->residual_moment(block.points[group.k[l]]); })};
}

// with_springs: whether any point of the scene has C.
template <class Weight>
small::Vector3<small::Lanes> forces(const MaterialBlock& block, const Group& group, const Displacements& u,
                                    const std::vector<ForceState>& states, bool with_springs, Weight weight) {
  if (group.bundle) {
    const bonds::OfBundle family{*group.bundle};
    const auto own = bonds::own_state(family, states.data());
    return with_springs ? bonds::force<true>(family, u.sites, states.data(), own, weight)
                        : bonds::force<false>(family, u.sites, states.data(), own, weight);
  }
  return vectors(group, [&](int l) {
    const int i = block.points[group.k[l]];
    return group.chunk->force(i, u, states[i]);
  });
}

}  // namespace strut
