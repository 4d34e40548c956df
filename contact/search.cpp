#include "contact/search.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "points/cell_grid.hpp"
#include "points/common_box.hpp"
#include "points/near_ranks.hpp"

namespace strut::contact {

namespace {

using Box = Eigen::AlignedBox3d;

Vector place(const Site& site) { return site.current.head<3>().matrix(); }

// A point as it travels to other ranks.
struct Candidate {
  double reference[4], current[4];  // of Site
  double mass;
  std::int64_t id, block, owned;  // owned: its local index on the rank that owns it
};

Candidate candidate(const Crowd& crowd, int i) {
  const Site& site = crowd.sites[i];
  Candidate c{};
  std::copy_n(site.reference.data(), 4, c.reference);
  std::copy_n(site.current.data(), 4, c.current);
  c.mass = crowd.densities[i] * site.reference[3];
  c.id = crowd.domain.cloud.ids[i];
  c.block = crowd.domain.cloud.blocks[i];
  c.owned = i;
  return c;
}

Site site(const Candidate& c) {
  Site site;
  std::copy_n(c.reference, 4, site.reference.data());
  std::copy_n(c.current, 4, site.current.data());
  return site;
}

Vector place(const Candidate& c) { return {c.current[0], c.current[1], c.current[2]}; }
Vector reference(const Candidate& c) { return {c.reference[0], c.reference[1], c.reference[2]}; }

// The box of points over all ranks.
Box box_of(const Crowd& crowd, std::span<const int> points) {
  Box mine;
  for (const int i : points) mine.extend(place(crowd.sites[i]));
  return common_box(mine, crowd.domain.communicator);
}

// Those of `points` that lie within `reach` of the box.
void append_near(const Crowd& crowd, const std::vector<int>& points, const Box& box, double reach,
                 std::vector<int>& result) {
  if (box.isEmpty()) return;
  for (const int i : points) {
    if (box.squaredExteriorDistance(place(crowd.sites[i])) <= reach * reach) result.push_back(i);
  }
}

// Owned points that may have a partner at all, ascending.
std::vector<int> possible_points(const Crowd& crowd, const Parties& parties, double reach) {
  if (parties.self) return parties.first;
  std::vector<int> points;
  append_near(crowd, parties.first, box_of(crowd, parties.second), reach, points);
  append_near(crowd, parties.second, box_of(crowd, parties.first), reach, points);
  std::sort(points.begin(), points.end());
  return points;
}

// The points of an interaction that this rank knows: its own, then those of other ranks.
struct Pool {
  std::vector<Candidate> members;
  std::vector<Vector> places;
  std::size_t owned = 0;
};

Pool pool_of(const Crowd& crowd, const Parties& parties, double reach) {
  Pool pool;
  const std::vector<int> points = possible_points(crowd, parties, reach);
  pool.members.reserve(points.size());
  pool.places.reserve(points.size());
  for (const int i : points) pool.members.push_back(candidate(crowd, i));
  for (const Candidate& c : pool.members) pool.places.push_back(place(c));
  pool.owned = pool.members.size();
  const auto others = from_near_ranks<Candidate>(pool.places, pool.members, reach, crowd.domain.communicator);
  pool.members.insert(pool.members.end(), others.begin(), others.end());
  for (const Candidate& c : others) pool.places.push_back(place(c));
  return pool;
}

// Whether two members of the pool, `distance2` from each other (squared), may touch before they have come closer by the
// skin.
struct Criterion {
  double radius, skin;
  const Parties& parties;

  bool operator()(const Candidate& a, const Candidate& b, double distance2) const {
    if (!parties.self && a.block == b.block) return false;
    if (!parties.one_body) return true;
    const Vector xi = reference(b) - reference(a);
    const double reach = touching_distance(radius, xi.norm()) + skin;
    return distance2 <= reach * reach && !bonded(a.current[3], b.current[3], xi);
  }
};

// Where a body was in its reference state, sorted into the cells of where it is now.
//
// Where material has hardly been deformed nothing of one body can touch: points that are not bonded were a horizon or
// more apart, and touch when they have come closer by a tenth of that. So two cells need no look where no two
// displacements of their points differ by as much, less the skin. In a body that falls or turns little that is almost
// everywhere. Elsewhere most of what is near has been near: two points that were within the smallest horizon are
// bonded.
class Memory {
 public:
  Memory(const CellGrid& grid, const Pool& pool, const Criterion& criterion) : begin_(grid.cells()) {
    if (!criterion.parties.one_body) return;
    boxes_.resize(grid.cells());
    references_.reserve(pool.members.size());
    double horizon = std::numeric_limits<double>::infinity();
    for (int c = 0; c < grid.cells(); ++c) {
      begin_[c] = references_.size();
      for (const int m : grid.members(c)) {
        const Candidate& member = pool.members[m];
        references_.push_back(reference(member));
        boxes_[c].extend(place(member) - references_.back());
        horizon = std::min(horizon, member.current[3]);
      }
    }
    horizon2_ = horizon * horizon;
    limit_ = (1 - reference_share) * horizon - criterion.skin;
  }

  bool is_calm_between(int one, int other) const {
    if (boxes_.empty()) return false;
    const Vector apart = (boxes_[one].max() - boxes_[other].min()).cwiseMax(boxes_[other].max() - boxes_[one].min());
    return apart.squaredNorm() < limit_ * std::abs(limit_);
  }

  // Whether a point that was at `reference` is certainly bonded to the k-th of a cell.
  bool bonded(const Vector& reference, int cell, std::size_t k) const {
    return !boxes_.empty() && (references_[begin_[cell] + k] - reference).squaredNorm() <= horizon2_;
  }

 private:
  std::vector<std::size_t> begin_;   // of cells, in references_
  std::vector<Vector> references_;   // in the order of the cells' members; none between bodies
  std::vector<Box> boxes_;           // of displacements, of cells
  double horizon2_ = 0, limit_ = 0;  // the smallest horizon, squared, m²; m
};

// Partners of the pool's owned members, as places in the pool, ordered by id.
struct Lists {
  std::vector<std::size_t> start;
  std::vector<int> partners;
};

Lists lists_of(const Pool& pool, const Criterion& may_touch, double reach) {
  const CellGrid grid(pool.places, reach);
  const Memory memory(grid, pool, may_touch);
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> near;
  for (int cell = 0; cell < grid.cells(); ++cell) {
    if (grid.members(cell).empty()) continue;
    near.clear();
    grid.visit_cells_near(cell, [&](int other) {
      if (!grid.members(other).empty() && !memory.is_calm_between(cell, other)) near.push_back(other);
    });
    for (const int k : grid.members(cell)) {
      if (k >= static_cast<int>(pool.owned)) continue;
      const Vector here = pool.places[k], was = reference(pool.members[k]);
      for (const int there : near) {
        const std::span<const Vector> places = grid.places(there);
        for (std::size_t m = 0; m < places.size(); ++m) {
          const double distance2 = (places[m] - here).squaredNorm();
          if (distance2 > reach * reach || memory.bonded(was, there, m)) continue;
          const int other = grid.members(there)[m];
          if (other != k && may_touch(pool.members[k], pool.members[other], distance2)) pairs.emplace_back(k, other);
        }
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) {
    return std::pair(a.first, pool.members[a.second].id) < std::pair(b.first, pool.members[b.second].id);
  });
  Lists lists{std::vector<std::size_t>(pool.owned + 1, 0), {}};
  for (const auto& [k, partner] : pairs) {
    ++lists.start[k + 1];
    lists.partners.push_back(partner);
  }
  for (std::size_t k = 0; k < pool.owned; ++k) lists.start[k + 1] += lists.start[k];
  return lists;
}

// The members of the pool that are in a pair: owned ones, then the others by id.
std::vector<int> paired_members(const Pool& pool, const Lists& lists) {
  std::vector<int> members, others;
  for (std::size_t k = 0; k < pool.owned; ++k) {
    if (lists.start[k + 1] > lists.start[k]) members.push_back(static_cast<int>(k));
  }
  for (const int partner : lists.partners) {
    if (partner >= static_cast<int>(pool.owned)) others.push_back(partner);
  }
  std::sort(others.begin(), others.end(), [&](int a, int b) { return pool.members[a].id < pool.members[b].id; });
  others.erase(std::unique(others.begin(), others.end()), others.end());
  members.insert(members.end(), others.begin(), others.end());
  return members;
}

void make_halo(const Communicator& communicator, const Pool& pool, const std::vector<int>& members, Pairs& pairs) {
  std::vector<std::int64_t> owned, others;
  for (const int m : members) (m < static_cast<int>(pool.owned) ? owned : others).push_back(pool.members[m].id);
  if (communicator.sum(static_cast<std::int64_t>(others.size())) > 0) pairs.halo.emplace(communicator, owned, others);
}

}  // namespace

Pairs find_pairs(const Crowd& crowd, const Parties& parties, const Model& model, double skin) {
  const double reach = model.radius + skin;
  const Pool pool = pool_of(crowd, parties, reach);
  const Lists lists = lists_of(pool, {model.radius, skin, parties}, reach);
  const std::vector<int> members = paired_members(pool, lists);
  Pairs pairs;
  pairs.one_body = parties.one_body;
  std::vector<int> local(pool.members.size(), -1);
  for (const int m : members) {
    const Candidate& member = pool.members[m];
    local[m] = static_cast<int>(pairs.sites.size());
    pairs.sites.push_back(site(member));
    pairs.masses.push_back(member.mass);
    if (m >= static_cast<int>(pool.owned)) continue;
    pairs.owned.push_back(static_cast<int>(member.owned));
    pairs.start.push_back(pairs.start.back() + lists.start[m + 1] - lists.start[m]);
  }
  for (const int partner : lists.partners) pairs.partners.push_back(local[partner]);
  make_halo(crowd.domain.communicator, pool, members, pairs);
  return pairs;
}

double distance_of_boxes(const Crowd& crowd, const Parties& parties) {
  const Box one = box_of(crowd, parties.first), other = box_of(crowd, parties.second);
  if (one.isEmpty() || other.isEmpty()) return std::numeric_limits<double>::infinity();
  return one.exteriorDistance(other);
}

}  // namespace strut::contact
