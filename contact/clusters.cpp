#include "contact/clusters.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "base/small_tensors.hpp"
#include "points/cell_grid.hpp"

namespace strut::contact {

namespace {

using Box = Eigen::AlignedBox3d;
using small::Lanes;
constexpr int width = small::lane_count;

// What is asked of wholes and in registers must not rule out a pair by round-off.
constexpr double round_off = 1e-9;

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

// A cluster as a whole.
struct Whole {
  Vector centre, shift;       // of the box of references, m; of displacements
  double size, spread, skin;  // half the diagonals of these boxes; the largest skin of a point, m
  double radius() const { return size + spread; }
};

// The clusters of one block's members.
class Clusters {
 public:
  Clusters(const Pool& pool, int block, double cell) : grid_(places_of(pool, block), cell, cell) {
    first_.push_back(0);
    for (int c = 0; c < grid_.cells(); ++c) {
      if (!grid_.members(c).empty()) add(pool, c);
      first_.push_back(count());
    }
    centre_.close(), shift_.close(), size_.close(), spread_.close(), skin_.close(), place_.close(), reference_.close();
  }

  int count() const { return static_cast<int>(start_.size()) - 1; }
  std::span<const int> members(int c) const { return {members_.data() + start_[c], members_.data() + start_[c + 1]}; }
  Whole whole(int c) const { return {centre_[c], shift_[c], size_[c], spread_[c], skin_[c]}; }

  // Calls visit(c) for the clusters that are not ruled out as wholes beside `one`. `horizon`: the smallest; 0 between
  // bodies.
  template <class Visit>
  void visit_near(const Whole& one, double radius, double horizon, const Visit& visit) const;

  // Calls visit(m) for the members of a cluster that are not ruled out beside a point.
  template <class Visit>
  void visit_near(const Candidate& point, int c, double radius, double horizon, const Visit& visit) const;

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

  std::vector<int> in_block_;  // members of the pool
  CellGrid grid_;              // of these
  std::vector<int> first_;     // the first cluster of each cell of the grid, or after it
  std::vector<std::size_t> start_{0};
  std::vector<int> members_;  // of the pool, by clusters
  // Of clusters.
  Columns3 centre_, shift_;
  Column size_, spread_, skin_;
  double largest_skin_ = 0, largest_radius_ = 0;
  // In the order of members_.
  Columns3 place_, reference_;
};

void Clusters::add(const Pool& pool, int cell) {
  Box references, displacements;
  double skin = 0;
  for (const int n : grid_.members(cell)) {
    const Candidate& member = pool.members[in_block_[n]];
    const Vector X = reference(member), y = place(member);
    references.extend(X);
    displacements.extend(y - X);
    skin = std::max(skin, member.skin);
    members_.push_back(in_block_[n]);
    place_.add(y), reference_.add(X);
  }
  start_.push_back(members_.size());
  centre_.add(references.center()), shift_.add(displacements.center());
  size_.add(0.5 * references.diagonal().norm()), spread_.add(0.5 * displacements.diagonal().norm());
  skin_.add(skin);
  largest_skin_ = std::max(largest_skin_, skin);
  largest_radius_ = std::max(largest_radius_, whole(count() - 1).radius());
}

Lanes squared_length(const Lanes* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

template <class Visit>
void Clusters::visit_near(const Whole& one, double radius, double horizon, const Visit& visit) const {
  const double slack = round_off * radius;
  // What rules a cluster out is not negative.
  const auto ruled_out = [&](int c) -> Lanes {
    Lanes xi[3], eta[3], way[3];
    for (int k = 0; k < 3; ++k) {
      xi[k] = centre_.c[k].at(c) - one.centre[k];
      way[k] = shift_.c[k].at(c) - one.shift[k];
      eta[k] = xi[k] + way[k];
    }
    const Lanes sizes = size_.at(c) + one.size, spreads = spread_.at(c) + one.spread, skins = skin_.at(c) + one.skin;
    const Lanes now2 = squared_length(eta), reach = radius + skins + sizes + spreads + slack;
    const Lanes far = now2 - reach * reach;
    if (horizon == 0 || far.minCoeff() >= 0) return far;
    const Lanes now = now2.sqrt(), then = squared_length(xi).sqrt();
    const Lanes bonded = horizon - (then + sizes);
    const Lanes lengths = then + now - 2 * sizes;
    const Lanes nearer =
        now - then - 2 * sizes * squared_length(way).sqrt() / lengths.max(1e-3 * horizon) - spreads - skins;
    const Lanes calm = (nearer + ((1 - reference_share) * horizon - slack)).min(lengths - 0.5 * horizon);
    return far.max(bonded).max(calm);
  };
  const double reach = radius + one.skin + largest_skin_ + one.radius() + largest_radius_;
  const Vector here = one.centre + one.shift, around = Vector::Constant(reach);
  grid_.visit_rows(Box(here - around, here + around), [&](int begin, int end) {
    for (int c = first_[begin]; c < first_[end]; c += width) {
      const Lanes out = ruled_out(c);
      if (out.minCoeff() >= 0) continue;
      for (int l = 0; l < std::min(width, first_[end] - c); ++l) {
        if (out[l] < 0) visit(c + l);
      }
    }
  });
}

template <class Visit>
void Clusters::visit_near(const Candidate& point, int c, double radius, double horizon, const Visit& visit) const {
  const double skins = point.skin + skin_[c] + round_off * radius;
  const int end = static_cast<int>(start_[c + 1]);
  for (int m = static_cast<int>(start_[c]); m < end; m += width) {
    Lanes eta[3], xi[3];
    for (int k = 0; k < 3; ++k) {
      eta[k] = place_.c[k].at(m) - point.current[k];
      xi[k] = reference_.c[k].at(m) - point.reference[k];
    }
    const Lanes then2 = squared_length(xi);
    const Lanes reach = (horizon > 0 ? Lanes((reference_share * then2.sqrt()).min(radius)) : Lanes::Constant(radius));
    const Lanes far = squared_length(eta) - (reach + skins).square();
    const Lanes out = far.max(horizon * horizon - then2);
    if (out.minCoeff() >= 0) continue;
    for (int l = 0; l < std::min(width, end - m); ++l) {
      if (out[l] < 0) visit(members_[m + l]);
    }
  }
}

void add_pairs(const Pool& pool, const Criterion& may_touch, double horizon, const Clusters& some,
               const Clusters& others, IndexPairs& pairs) {
  std::vector<int> near;
  const auto is_owned = [&pool](int m) { return m < static_cast<int>(pool.owned); };
  for (int c = 0; c < some.count(); ++c) {
    if (std::none_of(some.members(c).begin(), some.members(c).end(), is_owned)) continue;
    near.clear();
    others.visit_near(some.whole(c), may_touch.radius, horizon, [&near](int other) { near.push_back(other); });
    for (const int m : some.members(c)) {
      if (!is_owned(m)) continue;
      const Candidate& member = pool.members[m];
      for (const int cluster : near) {
        others.visit_near(member, cluster, may_touch.radius, horizon, [&](int other) {
          if (other != m && may_touch(member, pool.members[other])) pairs.emplace_back(m, other);
        });
      }
    }
  }
}

// Of a cell for about eight points where they are dense, m.
double cell_width(const Pool& pool) {
  double volume = 0;
  for (const Candidate& member : pool.members) volume += member.reference[3];
  return 2 * std::cbrt(volume / static_cast<double>(pool.members.size()));
}

}  // namespace

IndexPairs pairs_in(const Pool& pool, const Criterion& may_touch) {
  IndexPairs pairs;
  if (pool.members.empty()) return pairs;
  const Parties& parties = may_touch.parties;
  double horizon = std::numeric_limits<double>::infinity();
  for (const Candidate& member : pool.members) horizon = std::min(horizon, member.current[3]);
  if (!parties.one_body) horizon = 0;
  const double width = cell_width(pool);
  const Clusters first(pool, parties.first, width);
  if (parties.self()) {
    add_pairs(pool, may_touch, horizon, first, first, pairs);
    return pairs;
  }
  const Clusters second(pool, parties.second, width);
  add_pairs(pool, may_touch, horizon, first, second, pairs);
  add_pairs(pool, may_touch, horizon, second, first, pairs);
  return pairs;
}

}  // namespace strut::contact
