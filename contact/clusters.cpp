#include "contact/clusters.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "base/small_tensors.hpp"
#include "points/cell_grid.hpp"

namespace strut::contact {

namespace {

using Box = Eigen::AlignedBox3d;
using small::Lanes;
constexpr int width = small::lane_count;

// What is asked of wholes and in registers must not rule out a pair by round-off.
constexpr double round_off = 1e-9;

// A cluster whose points are this near to where they were, in units of its size, is not asked how it has turned.
constexpr double hardly_turned = 2e-3;

// Numbers that are read some at a time, from any place.
class Column {
 public:
  void add(double value) { values_.push_back(value); }
  void close() { values_.insert(values_.end(), width, 0.0); }  // so that the last ones can be read as any
  double operator[](std::size_t i) const { return values_[i]; }
  Lanes at(std::size_t i) const { return Eigen::Map<const Lanes>(values_.data() + i); }

 private:
  std::vector<double> values_;
};

struct Columns3 {
  Column c[3];

  void add(const Vector& v) {
    for (int k = 0; k < 3; ++k) c[k].add(v[k]);
  }
  void close() {
    for (Column& column : c) column.close();
  }
  Vector operator[](std::size_t i) const { return {c[0][i], c[1][i], c[2][i]}; }
};

// A cluster as a whole: y = place + rotation (X − reference) but for `spread`.
struct Whole {
  Vector place, reference;            // of its centre, m
  double radius, size, spread, skin;  // the largest |y − place|, |X − reference|, and skin of a point, m
  Tensor rotation;
};

// The rotation R that comes nearest to y − place = R (X − reference): of the moment Σ (y − place) ⊗ (X − reference).
Tensor fitted_rotation(const Tensor& moment) {
  const Eigen::JacobiSVD<Tensor> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Tensor U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) *= -1;
  return U * svd.matrixV().transpose();
}

// Of a cell for about eight points of a block where they are dense, m.
double cell_width(const Pool& pool, int block) {
  double volume = 0, count = 0;
  for (const Candidate& member : pool.members) {
    if (member.block == block) volume += member.reference[3], ++count;
  }
  return count > 0 ? 2 * std::cbrt(volume / count) : 1;
}

// The clusters of one block's members.
class Clusters {
 public:
  Clusters(const Pool& pool, int block) : grid_(CellGrid::of_width(places_of(pool, block), cell_width(pool, block))) {
    first_.push_back(0);
    for (int c = 0; c < grid_.cells(); ++c) {
      if (!grid_.members(c).empty()) add(pool, c);
      first_.push_back(count());
    }
    for (Columns3* columns : {&centre_, &centre_reference_, &place_, &reference_}) columns->close();
    for (Column* column : {&radius_, &size_, &spread_, &skin_}) column->close();
    for (Column& column : rotation_) column.close();
  }

  int count() const { return static_cast<int>(start_.size()) - 1; }
  std::span<const int> members(int c) const { return {members_.data() + start_[c], members_.data() + start_[c + 1]}; }
  Whole whole(int c) const {
    Tensor R;
    for (int n = 0; n < 9; ++n) R.data()[n] = rotation_[n][c];
    return {centre_[c], centre_reference_[c], radius_[c], size_[c], spread_[c], skin_[c], R};
  }

  // Calls visit(c) for the clusters that are not ruled out as wholes beside `one`. `horizon`: the smallest; 0 between
  // bodies.
  template <class Visit>
  void visit_clusters_near(const Whole& one, double radius, double horizon, const Visit& visit) const;

  // Calls visit(m) for the members of a cluster that are not ruled out beside a point.
  template <class Visit>
  void visit_members_near(const Candidate& point, int c, double radius, double horizon, const Visit& visit) const;

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
  void add(const Pool& pool, int cell);
  void add_whole(const Whole& whole);

  std::vector<int> in_block_;  // members of the pool
  CellGrid grid_;              // of these
  std::vector<int> first_;     // the first cluster of each cell of the grid, or after it
  std::vector<std::size_t> start_{0};
  std::vector<int> members_;  // of the pool, by clusters
  // Of clusters.
  Columns3 centre_, centre_reference_;
  Column radius_, size_, spread_, skin_, rotation_[9];
  double largest_skin_ = 0;
  // In the order of members_.
  Columns3 place_, reference_;
};

void Clusters::add(const Pool& pool, int cell) {
  const std::span<const int> of_cell = grid_.members(cell);
  Whole whole{Vector::Zero(), Vector::Zero(), 0, 0, 0, 0, Tensor::Identity()};
  for (const int n : of_cell) {
    const Candidate& member = pool.members[in_block_[n]];
    const Vector X = reference(member), y = place(member);
    whole.reference += X / static_cast<double>(of_cell.size());
    whole.place += y / static_cast<double>(of_cell.size());
    whole.skin = std::max(whole.skin, member.skin);
    members_.push_back(in_block_[n]);
    place_.add(y), reference_.add(X);
  }
  const auto over_members = [&](const auto& visit) {
    for (std::size_t m = start_.back(); m < members_.size(); ++m) {
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
  start_.push_back(members_.size());
  add_whole(whole);
}

void Clusters::add_whole(const Whole& whole) {
  centre_.add(whole.place), centre_reference_.add(whole.reference);
  radius_.add(whole.radius), size_.add(whole.size), spread_.add(whole.spread), skin_.add(whole.skin);
  for (int n = 0; n < 9; ++n) rotation_[n].add(whole.rotation.data()[n]);
  largest_skin_ = std::max(largest_skin_, whole.skin);
}

// Calls visit(i) for the lanes below zero of those that stand for i = begin … end − 1.
template <class Visit>
void visit_below_zero(const Lanes& values, int begin, int end, const Visit& visit) {
  const unsigned there = (1u << std::min(width, end - begin)) - 1;
  for (unsigned left = small::lanes_below_zero(values) & there; left != 0; left &= left - 1) {
    visit(begin + std::countr_zero(left));
  }
}

Lanes squared_length(const Lanes* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

template <class Visit>
void Clusters::visit_clusters_near(const Whole& one, double radius, double horizon, const Visit& visit) const {
  const double slack = round_off * radius;
  // What rules a cluster out is not negative.
  const auto ruled_out = [&](int c) -> Lanes {
    Lanes apart[3];
    for (int k = 0; k < 3; ++k) apart[k] = centre_.c[k].at(c) - one.place[k];
    const Lanes skins = skin_.at(c) + one.skin, reach = radius + slack + skins + radius_.at(c) + one.radius;
    const Lanes far = squared_length(apart) - reach * reach;
    if (horizon == 0 || !small::lanes_below_zero(far)) return far;
    Lanes xi[3], way[3], turn2 = Lanes::Zero();
    for (int k = 0; k < 3; ++k) {
      xi[k] = centre_reference_.c[k].at(c) - one.reference[k];
      way[k] = one.rotation(0, k) * apart[0] + one.rotation(1, k) * apart[1] + one.rotation(2, k) * apart[2] - xi[k];
    }
    for (int n = 0; n < 9; ++n) turn2 += (rotation_[n].at(c) - one.rotation.data()[n]).square();
    const Lanes size = size_.at(c), sizes = size + one.size, spreads = spread_.at(c) + one.spread;
    const Lanes then = squared_length(xi).sqrt(), now = squared_length(apart).sqrt();
    const Lanes all_bonded = horizon - (then + sizes);
    const Lanes lengths = then + now - 2 * sizes;
    const Lanes by_place = 2 * sizes * squared_length(way).sqrt() / lengths.max(1e-3 * horizon);
    const Lanes nearer = now - then - by_place - size * turn2.sqrt() - spreads - skins;
    const Lanes calm = (nearer + ((1 - reference_share) * horizon - slack)).min(lengths - 0.5 * horizon);
    return far.max(all_bonded).max(calm);
  };
  const Vector around = Vector::Constant(radius + slack + one.skin + largest_skin_ + one.radius);
  grid_.visit_rows(Box(one.place - around, one.place + around), [&](int begin, int end) {
    for (int c = first_[begin]; c < first_[end]; c += width) visit_below_zero(ruled_out(c), c, first_[end], visit);
  });
}

template <class Visit>
void Clusters::visit_members_near(const Candidate& point, int c, double radius, double horizon,
                                  const Visit& visit) const {
  // The square of where a pair would touch, both skins added: of r_c, and of a share of |ξ| in the form a |ξ|² + b, for
  // |ξ| ≤ (|ξ|²/δ + δ)/2.
  const double skins = point.skin + skin_[c] + round_off * radius, most = (radius + skins) * (radius + skins);
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

void add_pairs(const Pool& pool, const Criterion& may_touch, double horizon, const Clusters& some,
               const Clusters& others, IndexPairs& pairs) {
  std::vector<int> near;
  const auto is_owned = [&pool](int m) { return m < static_cast<int>(pool.owned); };
  for (int c = 0; c < some.count(); ++c) {
    if (std::none_of(some.members(c).begin(), some.members(c).end(), is_owned)) continue;
    near.clear();
    others.visit_clusters_near(some.whole(c), may_touch.radius, horizon, [&near](int other) { near.push_back(other); });
    for (const int m : some.members(c)) {
      if (!is_owned(m)) continue;
      const Candidate& member = pool.members[m];
      for (const int cluster : near) {
        others.visit_members_near(member, cluster, may_touch.radius, horizon, [&](int other) {
          if (other != m && may_touch(member, pool.members[other])) pairs.emplace_back(m, other);
        });
      }
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
  if (!parties.one_body) horizon = 0;
  const Clusters first(pool, parties.first);
  if (parties.self()) {
    add_pairs(pool, may_touch, horizon, first, first, pairs);
    return pairs;
  }
  const Clusters second(pool, parties.second);
  add_pairs(pool, may_touch, horizon, first, second, pairs);
  add_pairs(pool, may_touch, horizon, second, first, pairs);
  return pairs;
}

}  // namespace strut::contact
