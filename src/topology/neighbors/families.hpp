// Families: the points within the horizon of a point, as neighbor lists or as stencils of a lattice.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/math/small_tensors.hpp"
#include "topology/neighbors/lattice.hpp"

namespace strut {

// Points that kernels process together, one per SIMD lane. They share one neighbor list, the union of their families; a
// mask says for each neighbor which of the points have it in their family. Points of a cluster lie close together, so
// most neighbors are in several of the families, and each neighbor is read once for all of them.
struct Cluster {
  static constexpr int width = small::lane_count;

  std::span<const int> points;  // local indices; at most `width`
  std::span<const int> near;
  const std::uint8_t* mask;  // of near: bit l is set if near[n] is in the family of points[l]
  std::size_t to_end;        // entries from near[0] to the end of the lists of all clusters: a prefetch may go so far

  std::size_t family_size(std::size_t l) const {  // of points[l]
    std::size_t size = 0;
    for (std::size_t n = 0; n < near.size(); ++n) size += mask[n] >> l & 1;
    return size;
  }
};

class ClusterLists {
 public:
  class Builder;

  int count() const { return static_cast<int>(first_.size()) - 1; }
  Cluster operator[](int b) const {
    const std::span points(points_.data() + first_[b], points_.data() + first_[b + 1]);
    const std::span near(near_.data() + start_[b], near_.data() + end_[b]);
    return {points, near, mask_.data() + start_[b], near_.size() - start_[b]};
  }
  std::size_t entries() const { return near_.size(); }
  double bytes() const {
    return static_cast<double>(points_.size() * sizeof(int) + near_.size() * (sizeof(int) + sizeof(std::uint8_t)) +
                               first_.size() * (sizeof(int) + 2 * sizeof(std::size_t)));
  }

  // The index of the cluster that contains point i, if points are numbered consecutively from cluster to cluster.
  int holding(int i) const {
    const auto begins_after = [this](int point, int b) { return point < points_[b]; };
    const auto after = std::upper_bound(first_.begin(), first_.end() - 1, i, begins_after);
    return static_cast<int>(after - first_.begin()) - 1;
  }
  // Calls visit(j) for the family of point i, with the same numbering.
  template <class Visit>
  void for_each(int i, Visit&& visit) const {
    const Cluster cluster = (*this)[holding(i)];
    const int lane = i - cluster.points[0];
    for (std::size_t n = 0; n < cluster.near.size(); ++n) {
      if (cluster.mask[n] >> lane & 1) visit(cluster.near[n]);
    }
  }

  // The index of the first point of a cluster among those of all clusters.
  int first(int b) const { return first_[b]; }

  // Appends a cluster of those points of `cluster` (of other lists) whose bits are set in `members`, with their
  // families.
  void append(const Cluster& cluster, unsigned members) {
    for (std::size_t l = 0; l < cluster.points.size(); ++l) {
      if (members >> l & 1) points_.push_back(cluster.points[l]);
    }
    for (std::size_t n = 0; n < cluster.near.size(); ++n) {
      unsigned mask = 0, bit = 1;
      for (unsigned left = members; left != 0; left &= left - 1, bit <<= 1) {
        if (cluster.mask[n] & left & -left) mask |= bit;
      }
      if (mask == 0) continue;
      near_.push_back(cluster.near[n]);
      mask_.push_back(static_cast<std::uint8_t>(mask));
    }
    close();
  }

  // Removes the n-th neighbor of cluster b from the families of its points whose bits are set in `members`.
  void cut(int b, std::size_t n, std::uint8_t members) { mask_[start_[b] + n] &= static_cast<std::uint8_t>(~members); }
  // Removes the neighbors of cluster b that cut() has left in no family; the others keep their order.
  void drop_cut(int b) {
    std::size_t kept = start_[b];
    for (std::size_t n = start_[b]; n < end_[b]; ++n) {
      if (mask_[n] == 0) continue;
      near_[kept] = near_[n];
      mask_[kept++] = mask_[n];
    }
    end_[b] = kept;
  }

  // Reserves memory for this many entries or more; unused memory is not touched.
  void reserve(std::size_t entries) { near_.reserve(entries), mask_.reserve(entries); }
  // Renumbers all points and neighbors by `numbers`.
  void renumber(const std::vector<int>& numbers) {
    for (int& i : points_) i = numbers[i];
    for (int& j : near_) j = numbers[j];
  }

 private:
  void close() {  // ends the last cluster
    first_.push_back(static_cast<int>(points_.size()));
    end_.push_back(near_.size());
    start_.push_back(near_.size());
  }

  std::vector<int> points_, first_{0};  // first_: index of the first point of each cluster
  std::vector<std::size_t> start_{0};   // start of the list of each cluster; last entry: start of the next
  std::vector<std::size_t> end_;        // end of the list of each cluster
  std::vector<int> near_;
  std::vector<std::uint8_t> mask_;
};

// Adds clusters one by one. `members`: number of points, neighbors included.
class ClusterLists::Builder {
 public:
  Builder(ClusterLists& clusters, std::size_t members) : lists_(clusters), mask_(members, 0) {}

  // for_each(i, visit) calls visit(j) for the family of i. The list is in the order of key(j).
  template <class ForEach, class Key>
  void add(std::span<const int> points, const ForEach& for_each, const Key& key) {
    near_.clear();
    for (std::size_t lane = 0; lane < points.size(); ++lane) {
      for_each(points[lane], [&](int j) {
        if (mask_[j] == 0) near_.push_back(j);
        mask_[j] |= 1u << lane;
      });
    }
    std::sort(near_.begin(), near_.end(), [&](int a, int b) { return key(a) < key(b); });
    lists_.points_.insert(lists_.points_.end(), points.begin(), points.end());
    for (const int j : near_) {
      lists_.near_.push_back(j);
      lists_.mask_.push_back(mask_[j]);
      mask_[j] = 0;
    }
    lists_.close();
  }

  // The same for any number of points, divided into clusters.
  template <class ForEach, class Key>
  void add_all(std::span<const int> points, const ForEach& for_each, const Key& key) {
    for (std::size_t at = 0; at < points.size(); at += Cluster::width) {
      add(points.subspan(at, std::min<std::size_t>(Cluster::width, points.size() - at)), for_each, key);
    }
  }

 private:
  ClusterLists& lists_;
  std::vector<std::uint8_t> mask_;  // of all members; 0 between calls
  std::vector<int> near_;
};

// Some points of a block, with lists of their own.
struct SelectedPoints {
  std::vector<int> places;  // indices in the block's points
  ClusterLists lists;
};

// The families of all owned points, as local indices of owned points and ghosts. The family of a point on a lattice is
// a stencil. All other points are in clusters; a cluster has points of one block, all interior or all boundary.
// Neighbors are in the order of the lattice or of global ids, so every sum over a family is the same on any number of
// ranks. If bonds of a lattice may break, its points are in clusters, too: for access to single bonds, and because
// points with broken bonds use lists.
struct Families {
  ClusterLists lists;
  std::vector<LatticeFamilies> lattices;
  std::vector<int> lattice_of;    // of owned points: index in lattices, −1 for lists; empty without a lattice
  std::vector<char> off_stencil;  // of owned points: bonds of its stencil have broken; empty if none on a lattice may
  // The far ends of the broken bonds of each owned point, local indices. Empty if no bond may break.
  std::vector<std::vector<int>> broken;

  bool is_off_stencil(int i) const { return !off_stencil.empty() && off_stencil[i]; }
  // The stencil that is the family of point i; nullptr if its family is a list.
  const LatticeFamilies* lattice(int i) const {
    return lattice_of.empty() || lattice_of[i] < 0 || is_off_stencil(i) ? nullptr : &lattices[lattice_of[i]];
  }

  // Calls visit(j) for the family of point i.
  template <class Visit>
  void for_each(int i, Visit&& visit) const {
    if (const LatticeFamilies* stencil = lattice(i)) return stencil->for_each(i, visit);
    lists.for_each(i, visit);
  }

  std::size_t size(int i) const {
    if (const LatticeFamilies* stencil = lattice(i)) return stencil->family_size(i);
    std::size_t count = 0;
    lists.for_each(i, [&count](int) { ++count; });
    return count;
  }
  std::size_t bonds() const;  // of all points; both ends count
  double bytes() const;
};

inline std::size_t Families::bonds() const {
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

inline double Families::bytes() const {
  double sum = lists.bytes();
  for (const LatticeFamilies& stencil : lattices) sum += stencil.bytes();
  return sum;
}

}  // namespace strut
