#include "contact/search/clusters.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "contact/search/bounding_volumes.hpp"
#include "topology/neighbors/cell_grid.hpp"

namespace strut::contact {

namespace {

using Box = Eigen::AlignedBox3d;
constexpr int width = small::lane_count;

// Points whose displacements are this small, relative to their extent, need no fitted rotation.
constexpr double hardly_turned = 2e-3;

// The rotation R that fits y − place = R (X − reference) best, from the moment Σ (y − place) ⊗ (X − reference).
Tensor fitted_rotation(const Tensor& moment) {
  const Eigen::JacobiSVD<Tensor> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Tensor U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) *= -1;
  return U * svd.matrixV().transpose();
}

// Width of a cell for about 64 points of a block where they are dense, m.
double cell_width(const CandidatePool& candidates, int block) {
  double volume = 0, count = 0;
  for (const Candidate& member : candidates.members) {
    if (member.block == block) volume += member.reference[3], ++count;
  }
  return count > 0 ? 4 * std::cbrt(volume / count) : 1;
}

// Calls visit(i) for the lanes below zero; the lanes stand for i = begin … end − 1.
template <class Visit>
void visit_below_zero(const Lanes& values, int begin, int end, const Visit& visit) {
  const unsigned there = (1u << std::min(width, end - begin)) - 1;
  for (unsigned left = small::lanes_below_zero(values) & there; left != 0; left &= left - 1) {
    visit(begin + std::countr_zero(left));
  }
}

// The clusters of one block's candidates, in cells.
class Clusters {
 public:
  Clusters(const CandidatePool& candidates, int block);

  int cells() const { return cells_.count(); }
  BoundingVolume cell(int n) const { return cells_[n]; }
  std::pair<int, int> clusters(int cell) const { return {first_cluster_[cell], first_cluster_[cell + 1]}; }
  BoundingVolume cluster(int c) const { return clusters_[c]; }
  std::span<const int> members(int c) const { return {members_.data() + start_[c], members_.data() + start_[c + 1]}; }

  std::span<const int> members_of_cell(int n) const {
    const auto [begin, end] = clusters(n);
    return {members_.data() + start_[begin], members_.data() + start_[end]};
  }

  // Call visit for the cells whose bounding volumes are not ruled out against `one`; for the clusters of one of them;
  // for the candidates of a cluster that are not ruled out against a point.
  template <class Visit>
  void visit_cells_near(const BoundingVolume& one, const Reach& reach, const Visit& visit) const;
  template <class Visit>
  void visit_clusters_near(const BoundingVolume& one, int cell, const Reach& reach, const Visit& visit) const {
    const auto [begin, end] = clusters(cell);
    for (int c = begin; c < end; c += width) visit_below_zero(clusters_.ruled_out(c, one, reach), c, end, visit);
  }
  template <class Visit>
  void visit_members_near(const Candidate& point, int c, const Reach& reach, const Visit& visit) const;

 private:
  std::vector<Vector> places_of(const CandidatePool& candidates, int block) {
    std::vector<Vector> places;
    for (std::size_t m = 0; m < candidates.members.size(); ++m) {
      if (candidates.members[m].block != block) continue;
      in_block_.push_back(static_cast<int>(m));
      places.push_back(place(candidates.members[m]));
    }
    return places;
  }
  void add_cell(const CandidatePool& candidates, int cell);
  BoundingVolume volume(const CandidatePool& candidates, std::size_t begin, std::size_t end) const;

  std::vector<int> in_block_;  // candidates
  CellGrid grid_;              // of these
  BoundingVolumes cells_, clusters_;
  std::vector<int> first_cell_{0};     // of each cell of the grid: the first nonempty cell from it on
  std::vector<int> first_cluster_{0};  // of each nonempty cell
  std::vector<std::size_t> start_{0};  // of each cluster's members_
  std::vector<int> members_;           // candidates, by clusters
  Columns3 place_, reference_;         // positions of these candidates
};

Clusters::Clusters(const CandidatePool& candidates, int block)
    : grid_(CellGrid::of_width(places_of(candidates, block), cell_width(candidates, block))) {
  for (int c = 0; c < grid_.cells(); ++c) {
    if (!grid_.members(c).empty()) add_cell(candidates, c);
    first_cell_.push_back(cells_.count());
  }
  for (Columns3* columns : {&place_, &reference_}) columns->close();
  for (BoundingVolumes* volumes : {&cells_, &clusters_}) volumes->close();
}

// Adds the candidates of a cell. Its clusters are the octants around their center.
void Clusters::add_cell(const CandidatePool& candidates, int cell) {
  const std::span<const int> of_cell = grid_.members(cell);
  Vector center = Vector::Zero();
  for (const int n : of_cell) center += place(candidates.members[in_block_[n]]) / static_cast<double>(of_cell.size());
  std::array<std::vector<int>, 8> octants;
  for (const int n : of_cell) {
    const Vector apart = place(candidates.members[in_block_[n]]) - center;
    octants[(apart[0] > 0) + 2 * (apart[1] > 0) + 4 * (apart[2] > 0)].push_back(in_block_[n]);
  }
  const std::size_t begin = members_.size();
  for (const std::vector<int>& octant : octants) {
    if (octant.empty()) continue;
    for (const int m : octant) {
      members_.push_back(m);
      place_.add(place(candidates.members[m])), reference_.add(reference(candidates.members[m]));
    }
    clusters_.add(volume(candidates, start_.back(), members_.size()));
    start_.push_back(members_.size());
  }
  cells_.add(volume(candidates, begin, members_.size()));
  first_cluster_.push_back(clusters_.count());
}

// The bounding volume of members_[begin] … members_[end − 1].
BoundingVolume Clusters::volume(const CandidatePool& candidates, std::size_t begin, std::size_t end) const {
  BoundingVolume volume{Vector::Zero(), Vector::Zero(), 0, 0, 0, 0, Tensor::Identity()};
  const double weight = 1 / static_cast<double>(end - begin);
  for (std::size_t m = begin; m < end; ++m) {
    volume.reference += weight * reference_[m];
    volume.place += weight * place_[m];
    volume.skin = std::max(volume.skin, candidates.members[members_[m]].skin);
  }
  const auto over_members = [&](const auto& visit) {
    for (std::size_t m = begin; m < end; ++m) {
      visit(Vector(reference_[m] - volume.reference), Vector(place_[m] - volume.place));
    }
  };
  const auto set_spread = [&] {
    volume.spread = 0;
    over_members([&volume](const Vector& xi, const Vector& eta) {
      volume.spread = std::max(volume.spread, (eta - volume.rotation * xi).norm());
    });
  };
  Tensor moment = Tensor::Zero();
  over_members([&](const Vector& xi, const Vector& eta) {
    volume.size = std::max(volume.size, xi.norm());
    volume.radius = std::max(volume.radius, eta.norm());
    moment += eta * xi.transpose();
  });
  set_spread();
  if (volume.spread > hardly_turned * volume.size) {
    volume.rotation = fitted_rotation(moment);
    set_spread();
  }
  return volume;
}

template <class Visit>
void Clusters::visit_cells_near(const BoundingVolume& one, const Reach& reach, const Visit& visit) const {
  const Vector around = Vector::Constant(reach.radius + reach.slack() + one.skin + cells_.largest_skin() + one.radius);
  grid_.visit_rows(Box(one.place - around, one.place + around), [&](int begin, int end) {
    for (int n = first_cell_[begin]; n < first_cell_[end]; n += width) {
      visit_below_zero(cells_.ruled_out(n, one, reach), n, first_cell_[end], visit);
    }
  });
}

template <class Visit>
void Clusters::visit_members_near(const Candidate& point, int c, const Reach& reach, const Visit& visit) const {
  // The squared touching distance with both skin distances: by r_c, and by the fraction of |ξ| in the form a |ξ|² + b,
  // an upper bound for |ξ| ≤ (|ξ|²/δ + δ)/2.
  const auto [radius, horizon] = reach;
  const double skins = point.skin + clusters_.skin(c) + reach.slack(), most = (radius + skins) * (radius + skins);
  const double a = reference_fraction * (reference_fraction + (horizon > 0 ? skins / horizon : 0));
  const double b = skins * (reference_fraction * horizon + skins);
  const int end = static_cast<int>(start_[c + 1]);
  for (int m = static_cast<int>(start_[c]); m < end; m += width) {
    Lanes eta[3], xi[3];
    for (int k = 0; k < 3; ++k) {
      eta[k] = place_.c[k].at(m) - point.current[k];
      xi[k] = reference_.c[k].at(m) - point.reference[k];
    }
    const Lanes then2 = squared_length(xi), now2 = squared_length(eta);
    Lanes out = now2 - most;
    if (horizon > 0) out = out.max(now2 - (a * then2 + b)).max(horizon * horizon - then2);
    visit_below_zero(out, m, end, [&](int n) { visit(members_[n]); });
  }
}

// Adds the pairs of owned candidates of a cluster with those of other clusters.
void add_pairs(const CandidatePool& candidates, const Criterion& may_touch, const Reach& reach,
               std::span<const int> members, const Clusters& others, const std::vector<int>& near, IndexPairs& pairs) {
  for (const int m : members) {
    if (!candidates.owns(m)) continue;
    const Candidate& member = candidates.members[m];
    for (const int cluster : near) {
      others.visit_members_near(member, cluster, reach, [&](int other) {
        if (other != m && may_touch(member, candidates.members[other])) pairs.emplace_back(m, other);
      });
    }
  }
}

void add_pairs(const CandidatePool& candidates, const Criterion& may_touch, const Reach& reach, const Clusters& some,
               const Clusters& others, IndexPairs& pairs) {
  std::vector<int> cells, near;
  for (int n = 0; n < some.cells(); ++n) {
    if (std::ranges::none_of(some.members_of_cell(n), [&candidates](int m) { return candidates.owns(m); })) continue;
    cells.clear();
    others.visit_cells_near(some.cell(n), reach, [&](int cell) { cells.push_back(cell); });
    const auto [begin, end] = some.clusters(n);
    for (int c = begin; !cells.empty() && c < end; ++c) {
      near.clear();
      for (const int cell : cells) {
        others.visit_clusters_near(some.cluster(c), cell, reach, [&](int cluster) { near.push_back(cluster); });
      }
      add_pairs(candidates, may_touch, reach, some.members(c), others, near, pairs);
    }
  }
}

}  // namespace

IndexPairs pairs_in(const CandidatePool& candidates, const Criterion& may_touch) {
  IndexPairs pairs;
  if (candidates.members.empty()) return pairs;
  const BlockPair& blocks = may_touch.blocks;
  double horizon = std::numeric_limits<double>::infinity();
  for (const Candidate& member : candidates.members) horizon = std::min(horizon, member.current[3]);
  const Reach reach{may_touch.radius, blocks.one_body ? horizon : 0};
  const Clusters first(candidates, blocks.first);
  if (blocks.self()) {
    add_pairs(candidates, may_touch, reach, first, first, pairs);
    return pairs;
  }
  const Clusters second(candidates, blocks.second);
  add_pairs(candidates, may_touch, reach, first, second, pairs);
  add_pairs(candidates, may_touch, reach, second, first, pairs);
  return pairs;
}

}  // namespace strut::contact
