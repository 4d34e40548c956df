#include "contact/clusters.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "contact/wholes.hpp"
#include "points/cell_grid.hpp"

namespace strut::contact {

namespace {

using Box = Eigen::AlignedBox3d;
constexpr int width = small::lane_count;

// A whole whose points are this near to where they were, in units of its size, is not asked how it has turned.
constexpr double hardly_turned = 2e-3;

// The rotation R that comes nearest to y − place = R (X − reference): of the moment Σ (y − place) ⊗ (X − reference).
Tensor fitted_rotation(const Tensor& moment) {
  const Eigen::JacobiSVD<Tensor> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Tensor U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) *= -1;
  return U * svd.matrixV().transpose();
}

// Of a cell for about 64 points of a block where they are dense, m.
double cell_width(const Pool& pool, int block) {
  double volume = 0, count = 0;
  for (const Candidate& member : pool.members) {
    if (member.block == block) volume += member.reference[3], ++count;
  }
  return count > 0 ? 4 * std::cbrt(volume / count) : 1;
}

// Calls visit(i) for the lanes below zero of those that stand for i = begin … end − 1.
template <class Visit>
void visit_below_zero(const Lanes& values, int begin, int end, const Visit& visit) {
  const unsigned there = (1u << std::min(width, end - begin)) - 1;
  for (unsigned left = small::lanes_below_zero(values) & there; left != 0; left &= left - 1) {
    visit(begin + std::countr_zero(left));
  }
}

// The clusters of one block's members, in clumps.
class Clusters {
 public:
  Clusters(const Pool& pool, int block);

  int clumps() const { return clumps_.count(); }
  Whole clump(int n) const { return clumps_[n]; }
  std::pair<int, int> clusters(int clump) const { return {first_cluster_[clump], first_cluster_[clump + 1]}; }
  Whole cluster(int c) const { return clusters_[c]; }
  std::span<const int> members(int c) const { return {members_.data() + start_[c], members_.data() + start_[c + 1]}; }

  std::span<const int> members_of_clump(int n) const {
    const auto [begin, end] = clusters(n);
    return {members_.data() + start_[begin], members_.data() + start_[end]};
  }

  // Calls visit for the clumps that are not ruled out as wholes beside `one`; for the clusters of one of them; for the
  // members of a cluster that are not ruled out beside a point.
  template <class Visit>
  void visit_clumps_near(const Whole& one, const Reach& reach, const Visit& visit) const;
  template <class Visit>
  void visit_clusters_near(const Whole& one, int clump, const Reach& reach, const Visit& visit) const {
    const auto [begin, end] = clusters(clump);
    for (int c = begin; c < end; c += width) visit_below_zero(clusters_.ruled_out(c, one, reach), c, end, visit);
  }
  template <class Visit>
  void visit_members_near(const Candidate& point, int c, const Reach& reach, const Visit& visit) const;

 private:
  std::vector<Vector> places_of(const Pool& pool, int block) {
    std::vector<Vector> places;
    for (std::size_t m = 0; m < pool.members.size(); ++m) {
      if (pool.members[m].block != block) continue;
      in_block_.push_back(static_cast<int>(m));
      places.push_back(place(pool.members[m]));
    }
    return places;
  }
  void add_clump(const Pool& pool, int cell);
  Whole whole(const Pool& pool, std::size_t begin, std::size_t end) const;

  std::vector<int> in_block_;  // members of the pool
  CellGrid grid_;              // of these
  Wholes clumps_, clusters_;
  std::vector<int> first_clump_{0};    // of each cell of the grid, or after it
  std::vector<int> first_cluster_{0};  // of each clump
  std::vector<std::size_t> start_{0};  // of each cluster's members
  std::vector<int> members_;           // of the pool, by clusters
  Columns3 place_, reference_;         // theirs
};

Clusters::Clusters(const Pool& pool, int block)
    : grid_(CellGrid::of_width(places_of(pool, block), cell_width(pool, block))) {
  for (int c = 0; c < grid_.cells(); ++c) {
    if (!grid_.members(c).empty()) add_clump(pool, c);
    first_clump_.push_back(clumps_.count());
  }
  for (Columns3* columns : {&place_, &reference_}) columns->close();
  for (Wholes* wholes : {&clumps_, &clusters_}) wholes->close();
}

// The points of a cell. Its clusters are the octants about their centre.
void Clusters::add_clump(const Pool& pool, int cell) {
  const std::span<const int> of_cell = grid_.members(cell);
  Vector centre = Vector::Zero();
  for (const int n : of_cell) centre += place(pool.members[in_block_[n]]) / static_cast<double>(of_cell.size());
  std::array<std::vector<int>, 8> octants;
  for (const int n : of_cell) {
    const Vector apart = place(pool.members[in_block_[n]]) - centre;
    octants[(apart[0] > 0) + 2 * (apart[1] > 0) + 4 * (apart[2] > 0)].push_back(in_block_[n]);
  }
  const std::size_t begin = members_.size();
  for (const std::vector<int>& octant : octants) {
    if (octant.empty()) continue;
    for (const int m : octant) {
      members_.push_back(m);
      place_.add(place(pool.members[m])), reference_.add(reference(pool.members[m]));
    }
    clusters_.add(whole(pool, start_.back(), members_.size()));
    start_.push_back(members_.size());
  }
  clumps_.add(whole(pool, begin, members_.size()));
  first_cluster_.push_back(clusters_.count());
}

// Of members_[begin] … members_[end − 1].
Whole Clusters::whole(const Pool& pool, std::size_t begin, std::size_t end) const {
  Whole whole{Vector::Zero(), Vector::Zero(), 0, 0, 0, 0, Tensor::Identity()};
  const double share = 1 / static_cast<double>(end - begin);
  for (std::size_t m = begin; m < end; ++m) {
    whole.reference += share * reference_[m];
    whole.place += share * place_[m];
    whole.skin = std::max(whole.skin, pool.members[members_[m]].skin);
  }
  const auto over_members = [&](const auto& visit) {
    for (std::size_t m = begin; m < end; ++m) {
      visit(Vector(reference_[m] - whole.reference), Vector(place_[m] - whole.place));
    }
  };
  const auto set_spread = [&] {
    whole.spread = 0;
    over_members([&whole](const Vector& xi, const Vector& eta) {
      whole.spread = std::max(whole.spread, (eta - whole.rotation * xi).norm());
    });
  };
  Tensor moment = Tensor::Zero();
  over_members([&](const Vector& xi, const Vector& eta) {
    whole.size = std::max(whole.size, xi.norm());
    whole.radius = std::max(whole.radius, eta.norm());
    moment += eta * xi.transpose();
  });
  set_spread();
  if (whole.spread > hardly_turned * whole.size) {
    whole.rotation = fitted_rotation(moment);
    set_spread();
  }
  return whole;
}

template <class Visit>
void Clusters::visit_clumps_near(const Whole& one, const Reach& reach, const Visit& visit) const {
  const Vector around = Vector::Constant(reach.radius + reach.slack() + one.skin + clumps_.largest_skin() + one.radius);
  grid_.visit_rows(Box(one.place - around, one.place + around), [&](int begin, int end) {
    for (int n = first_clump_[begin]; n < first_clump_[end]; n += width) {
      visit_below_zero(clumps_.ruled_out(n, one, reach), n, first_clump_[end], visit);
    }
  });
}

template <class Visit>
void Clusters::visit_members_near(const Candidate& point, int c, const Reach& reach, const Visit& visit) const {
  // The square of where a pair would touch, both skins added: of r_c, and of a share of |ξ| in the form a |ξ|² + b, for
  // |ξ| ≤ (|ξ|²/δ + δ)/2.
  const auto [radius, horizon] = reach;
  const double skins = point.skin + clusters_.skin(c) + reach.slack(), most = (radius + skins) * (radius + skins);
  const double a = reference_share * (reference_share + (horizon > 0 ? skins / horizon : 0));
  const double b = skins * (reference_share * horizon + skins);
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

// The pairs of owned members of a cluster with members of others.
void add_pairs(const Pool& pool, const Criterion& may_touch, const Reach& reach, std::span<const int> members,
               const Clusters& others, const std::vector<int>& near, IndexPairs& pairs) {
  for (const int m : members) {
    if (!pool.owns(m)) continue;
    const Candidate& member = pool.members[m];
    for (const int cluster : near) {
      others.visit_members_near(member, cluster, reach, [&](int other) {
        if (other != m && may_touch(member, pool.members[other])) pairs.emplace_back(m, other);
      });
    }
  }
}

void add_pairs(const Pool& pool, const Criterion& may_touch, const Reach& reach, const Clusters& some,
               const Clusters& others, IndexPairs& pairs) {
  std::vector<int> clumps, near;
  for (int n = 0; n < some.clumps(); ++n) {
    if (std::ranges::none_of(some.members_of_clump(n), [&pool](int m) { return pool.owns(m); })) continue;
    clumps.clear();
    others.visit_clumps_near(some.clump(n), reach, [&](int clump) { clumps.push_back(clump); });
    const auto [begin, end] = some.clusters(n);
    for (int c = begin; !clumps.empty() && c < end; ++c) {
      near.clear();
      for (const int clump : clumps) {
        others.visit_clusters_near(some.cluster(c), clump, reach, [&](int cluster) { near.push_back(cluster); });
      }
      add_pairs(pool, may_touch, reach, some.members(c), others, near, pairs);
    }
  }
}

}  // namespace

IndexPairs pairs_in(const Pool& pool, const Criterion& may_touch) {
  IndexPairs pairs;
  if (pool.members.empty()) return pairs;
  const Parties& parties = may_touch.parties;
  double horizon = std::numeric_limits<double>::infinity();
  for (const Candidate& member : pool.members) horizon = std::min(horizon, member.current[3]);
  const Reach reach{may_touch.radius, parties.one_body ? horizon : 0};
  const Clusters first(pool, parties.first);
  if (parties.self()) {
    add_pairs(pool, may_touch, reach, first, first, pairs);
    return pairs;
  }
  const Clusters second(pool, parties.second);
  add_pairs(pool, may_touch, reach, first, second, pairs);
  add_pairs(pool, may_touch, reach, second, first, pairs);
  return pairs;
}

}  // namespace strut::contact
