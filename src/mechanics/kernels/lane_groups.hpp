// Groups of points of a block, one point per SIMD lane, and the sums over their families. These come from the neighbor
// list of the points' cluster, or from the sums over their lattice.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "mechanics/kernels/bonds.hpp"
#include "mechanics/kernels/lattice_sums.hpp"

namespace strut {

enum class Part { interior, boundary };  // the points that need no ghost; the others

inline std::pair<int, int> range(const MaterialBlock& block, Part part) {
  if (part == Part::interior) return {0, block.interior};
  return {block.interior, static_cast<int>(block.points.size())};
}

struct LaneGroup {
  static constexpr int width = Cluster::width;

  std::array<int, width> k;  // indices in block.points; the last point fills the empty lanes
  Indices i;                 // the points
  int count;                 // number of points
  // The source of their sums: one of these two.
  std::optional<Cluster> cluster;
  const LatticeSums::Chunk* chunk;
  bool side_by_side;  // adjacent cells of a pencil

  LaneIndices lane_indices() const { return {i, side_by_side}; }
};

// Points of a block, in groups.
class LaneGroups {
 public:
  // The points of one part of a block that has neighbor lists.
  LaneGroups(const Body& body, const MaterialBlock& block, Part part) : points_(&block.points) {
    const auto [begin, end] = range(block, part);
    if (begin == end) return;
    lists_ = &body.domain.families.lists;
    begin_ = begin;
    first_ = lists_->holding(block.points[begin]);
    count_ = lists_->holding(block.points[end - 1]) + 1 - first_;
  }
  // The points in some slots of a lattice, without those that have lost bonds: first full groups of adjacent cells of a
  // pencil, whose sums are adjacent, too.
  LaneGroups(const MaterialBlock& block, const LatticeSums::Chunk& chunk) : points_(&block.points), chunk_(&chunk) {
    const std::vector<int>& off = block.off_stencil.places;
    for (const Part part : {Part::interior, Part::boundary}) {
      const auto [low, high] = range(block, part);
      const auto [begin, end] = chunk.part_of(block.points, low, high);
      auto next = std::lower_bound(off.begin(), off.end(), begin);
      for (int at = begin; at < end;) {
        const int stop = next == off.end() ? end : std::min(*next, end);
        add_runs(at, stop);
        at = stop + 1;
        if (next != off.end()) ++next;
      }
    }
    count_ = static_cast<int>(full_.size()) + groups_of(others_);
  }
  LaneGroups(const MaterialBlock& block, const SelectedPoints& chosen)
      : points_(&block.points), selected_(&chosen.places), lists_(&chosen.lists), count_(chosen.lists.count()) {}

  int count() const { return count_; }
  LaneGroup operator[](int g) const {
    const int full = static_cast<int>(full_.size());
    if (chunk_) {
      if (g < full) return of_run(full_[g], LaneGroup::width, {});
      const int begin = (g - full) * LaneGroup::width, left = static_cast<int>(others_.size()) - begin;
      return of_places(&others_[begin], std::min(left, LaneGroup::width), {});
    }
    const Cluster cluster = (*lists_)[first_ + g];
    const int count = static_cast<int>(cluster.points.size());
    if (selected_) return of_places(selected_->data() + lists_->first(g), count, cluster);
    return of_run(begin_ + cluster.points[0] - (*points_)[begin_], count, cluster);
  }

 private:
  // Adds the indices from `at` up to `end` of a chunk, as full groups of adjacent cells and as others.
  void add_runs(int at, int end) {
    constexpr int apart = LaneGroup::width - 1;
    while (at < end) {
      const int last = at + apart;
      if (last < end && chunk_->are_side_by_side((*points_)[at], (*points_)[last], apart)) {
        full_.push_back(at);
        at = last + 1;
      } else {
        others_.push_back(at++);
      }
    }
  }
  static int groups_of(const std::vector<int>& places) {
    return (static_cast<int>(places.size()) + LaneGroup::width - 1) / LaneGroup::width;
  }
  // A group of consecutive indices; a group of given indices.
  LaneGroup of_run(int begin, int count, std::optional<Cluster> cluster) const {
    return group(count, cluster, chunk_ != nullptr, [begin](int l) { return begin + l; });
  }
  LaneGroup of_places(const int* places, int count, std::optional<Cluster> cluster) const {
    return group(count, cluster, false, [places](int l) { return places[l]; });
  }
  template <class PlaceOf>
  LaneGroup group(int count, std::optional<Cluster> cluster, bool side_by_side, const PlaceOf& place_of) const {
    LaneGroup group{{}, {}, count, cluster, chunk_, side_by_side};
    for (int l = 0; l < LaneGroup::width; ++l) {
      group.k[l] = place_of(std::min(l, count - 1));
      group.i[l] = (*points_)[group.k[l]];
    }
    return group;
  }

  const std::vector<int>* points_;
  // Indices in block.points: on a lattice the first of each full group, and those in no full group; selected points.
  std::vector<int> full_, others_;
  const std::vector<int>* selected_ = nullptr;
  const ClusterLists* lists_ = nullptr;
  int begin_ = 0, first_ = 0, count_ = 0;  // index of the first point; its list; number of groups
  const LatticeSums::Chunk* chunk_ = nullptr;
};

// ---- Sums over the families of a group, of positions y or of a field in their place --------------------------------

// K = Σ ω V_j ξ ⊗ ξ in the reference state, m⁵.
template <class Weight>
small::Tensor3<small::Lanes> shapes(const LaneGroup& group, const Site* sites, Weight weight) {
  if (group.cluster) return bonds::gather<false>(bonds::OfCluster{*group.cluster}, sites, weight).tensor;
  return group.chunk->shapes(group.lane_indices());
}

// Σ ω V_j (v_j − v_i) ⊗ ξ of positions or of a field v: F K; on a lattice of displacements, so without the identity.
// with_springs: some point of the scene has springs on its own gradient, whose pull is then summed, too.
template <class Weight>
bonds::Moments<small::Lanes> moments(const LaneGroup& group, const Displacements& u, bool with_springs, Weight weight) {
  if (!group.cluster) return group.chunk->moments(group.lane_indices(), u);
  const bonds::OfCluster family{*group.cluster};
  return with_springs ? bonds::gather<true>(family, u.sites, weight) : bonds::gather<false>(family, u.sites, weight);
}

// The residual of both ends' gradients, penalized by the stabilization S.
template <class S, class Weight>
bonds::Residual<small::Lanes> residuals(std::size_t kind, const LaneGroup& group, const Site* places,
                                        const std::vector<GradientState>& gradients, Weight weight) {
  if (group.cluster) {
    return bonds::residual<S>(kind, bonds::OfCluster{*group.cluster}, places, gradients.data(), weight);
  }
  return {group.chunk->residual_forces(group.lane_indices()), group.chunk->residual_moments(group.lane_indices())};
}

// The force of the far ends of the bonds.
template <class Weight>
small::Vector3<small::Lanes> far_forces(const LaneGroup& group, const Displacements& u,
                                        const std::vector<ForceState>& states, bool with_springs, Weight weight) {
  if (!group.cluster) return group.chunk->forces(group.lane_indices(), u);
  const bonds::OfCluster family{*group.cluster};
  return with_springs ? bonds::far_force<true>(family, u.sites, states.data(), weight)
                      : bonds::far_force<false>(family, u.sites, states.data(), weight);
}

// Σ ω V ξ
inline small::Vector3<small::Lanes> first_moments(const LaneGroup& group, const Deduplicated<Vector>& moments) {
  return {{small::lanes_of([&](int l) { return moments[group.i[l]][0]; }),
           small::lanes_of([&](int l) { return moments[group.i[l]][1]; }),
           small::lanes_of([&](int l) { return moments[group.i[l]][2]; })}};
}

}  // namespace strut
