#include "contact/search.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "points/cell_grid.hpp"
#include "points/common_box.hpp"
#include "points/near_ranks.hpp"

namespace strut::contact {

namespace {

using Box = Eigen::AlignedBox3d;

// A point as it travels to other ranks.
struct Candidate {
  double reference[4], current[4];  // of Site
  double mass;
  std::int64_t id, block, owned;  // owned: its local index on the rank that owns it
  std::int64_t moved;             // whether its place is new
};

Candidate candidate(const Crowd& crowd, int i, const Vector& place) {
  const Site& site = crowd.sites[i];
  Candidate c{};
  std::copy_n(site.reference.data(), 4, c.reference);
  std::copy_n(place.data(), 3, c.current);
  c.current[3] = site.current[3];
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

// What a search is told (search.hpp).
struct Task {
  const Crowd& crowd;
  const Parties& parties;
  std::span<const Vector> places;
  const Model& model;
  double skin;

  double reach() const { return model.radius + skin; }
  int block(std::size_t k) const { return crowd.domain.cloud.blocks[parties.points[k]]; }
  const Communicator& communicator() const { return crowd.domain.communicator; }
};

// The box of the points of a block over all ranks.
Box box_of(const Crowd& crowd, const Parties& parties, std::span<const Vector> places, int block) {
  Box mine;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (crowd.domain.cloud.blocks[parties.points[k]] == block) mine.extend(places[k]);
  }
  return common_box(mine, crowd.domain.communicator);
}

// The points, as indices of parties.points, that may have a partner at all: those near the box of the other party.
std::vector<int> possible_points(const Task& task) {
  std::vector<int> points;
  Box boxes[2];
  if (!task.parties.self()) {
    boxes[0] = box_of(task.crowd, task.parties, task.places, task.parties.second);
    boxes[1] = box_of(task.crowd, task.parties, task.places, task.parties.first);
  }
  for (std::size_t k = 0; k < task.places.size(); ++k) {
    const Box& others = boxes[task.block(k) == task.parties.first ? 0 : 1];
    const bool near =
        !others.isEmpty() && others.squaredExteriorDistance(task.places[k]) <= task.reach() * task.reach();
    if (task.parties.self() || near) points.push_back(static_cast<int>(k));
  }
  return points;
}

// The points of an interaction that this rank knows: its own, then those of other ranks.
struct Pool {
  std::vector<Candidate> members;
  std::vector<Vector> places;
  std::size_t owned = 0;

  void add(const Candidate& c) {
    members.push_back(c);
    places.push_back(place(c));
  }
};

// Of the points parties.points[k], k in `points`, and those near them on other ranks. Both lists ascend.
Pool pool_of(const Task& task, const std::vector<int>& points, const std::vector<int>& moved = {}) {
  Pool pool;
  pool.members.reserve(points.size());
  pool.places.reserve(points.size());
  for (const int k : points) {
    pool.add(candidate(task.crowd, task.parties.points[k], task.places[k]));
    pool.members.back().moved = std::binary_search(moved.begin(), moved.end(), k);
  }
  pool.owned = pool.members.size();
  for (const Candidate& c : from_near_ranks<Candidate>(box_around(pool.places), pool.places, pool.members, task.reach(),
                                                       task.communicator())) {
    pool.add(c);
  }
  return pool;
}

// Whether two members of the pool, `distance2` from each other (squared), may touch before they have come closer by the
// skin.
struct Criterion {
  double radius, skin;
  const Parties& parties;

  bool operator()(const Candidate& a, const Candidate& b, double distance2) const {
    if (!parties.self() && a.block == b.block) return false;
    const Vector xi = reference(b) - reference(a);
    const double reach = touching_distance(radius, xi.norm(), parties.one_body) + skin;
    return distance2 <= reach * reach && !(parties.one_body && bonded(a.current[3], b.current[3], xi));
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

using IndexPairs = std::vector<std::pair<int, int>>;  // a member that is owned, and its partner: places in the pool

IndexPairs all_pairs(const Pool& pool, const Criterion& may_touch, double reach) {
  const CellGrid grid(pool.places, reach);
  const Memory memory(grid, pool, may_touch);
  IndexPairs pairs;
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
  return pairs;
}

// The members of a pool that have moved, of one block: a few, in cells.
class Moved {
 public:
  Moved(const Pool& pool, int block, double reach) : grid_({}, reach) {
    std::vector<Vector> places;
    for (std::size_t m = 0; m < pool.members.size(); ++m) {
      const Candidate& member = pool.members[m];
      if (!member.moved || member.block != block) continue;
      members_.push_back(static_cast<int>(m));
      references_.push_back(reference(member));
      places.push_back(pool.places[m]);
    }
    grid_ = CellGrid(places, reach);
  }

  // Calls visit(member, distance²) for those near a place, but for those whose references are within √bonded2 of `was`.
  template <class Visit>
  void visit_near(const Vector& here, const Vector& was, double reach2, double bonded2, const Visit& visit) const {
    grid_.visit_near(here, [&](int n, const Vector& there) {
      const double distance2 = (there - here).squaredNorm();
      if (distance2 <= reach2 && (references_[n] - was).squaredNorm() > bonded2) visit(members_[n], distance2);
    });
  }

 private:
  CellGrid grid_;
  std::vector<int> members_;
  std::vector<Vector> references_;
};

// Those one of whose members has moved; some of them twice. Within a body most of what is near is bonded.
IndexPairs pairs_of_moved(const Pool& pool, const Criterion& may_touch, double reach) {
  const Parties& parties = may_touch.parties;
  double horizon = std::numeric_limits<double>::infinity();  // the smallest
  for (const Candidate& member : pool.members) horizon = std::min(horizon, member.current[3]);
  const double bonded2 = parties.one_body ? horizon * horizon : -1;
  IndexPairs pairs;
  const int members = static_cast<int>(pool.members.size()), owned = static_cast<int>(pool.owned);
  const auto add_pairs = [&](int block, int other_block) {
    const Moved others(pool, other_block, reach);
    for (int k = 0; k < members; ++k) {
      const Candidate& member = pool.members[k];
      if (member.block != block) continue;
      others.visit_near(pool.places[k], reference(member), reach * reach, bonded2, [&](int other, double distance2) {
        if (other == k || !may_touch(member, pool.members[other], distance2)) return;
        if (k < owned) pairs.emplace_back(k, other);
        if (other < owned) pairs.emplace_back(other, k);
      });
    }
  };
  add_pairs(parties.first, parties.second);
  if (!parties.self()) add_pairs(parties.second, parties.first);
  return pairs;
}

// Partners of the pool's owned members, as places in the pool, ordered by id.
struct Lists {
  std::vector<std::size_t> start{0};
  std::vector<int> partners;

  void close() { start.push_back(partners.size()); }  // the list of one more member is complete
  auto of(std::size_t k) const { return std::span(partners).subspan(start[k], start[k + 1] - start[k]); }
};

// Pairs of the same member are put side by side first: sorting all at once would take several times as long.
Lists lists_of(const Pool& pool, const IndexPairs& pairs) {
  std::vector<std::size_t> ends(pool.owned + 1, 0);
  for (const auto& pair : pairs) ++ends[pair.first + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::pair<std::int64_t, int>> all(pairs.size());  // ids and members
  std::vector<std::size_t> next(ends.begin(), ends.end() - 1);
  for (const auto& [k, other] : pairs) all[next[k]++] = {pool.members[other].id, other};
  Lists lists;
  for (std::size_t k = 0; k < pool.owned; ++k) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(ends[k]),
               end = all.begin() + static_cast<std::ptrdiff_t>(ends[k + 1]);
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    for (auto at = begin; at != last; ++at) lists.partners.push_back(at->second);
    lists.close();
  }
  return lists;
}

Lists merged(const Pool& pool, const Lists& a, const Lists& b) {
  std::vector<std::int64_t> ids;
  for (const Candidate& member : pool.members) ids.push_back(member.id);
  Lists lists;
  for (std::size_t k = 0; k < pool.owned; ++k) {
    std::ranges::set_union(
        a.of(k), b.of(k), std::back_inserter(lists.partners), {}, [&](int m) { return ids[m]; },
        [&](int m) { return ids[m]; });
    lists.close();
  }
  return lists;
}

// The members of the pool that are in a pair: owned ones, then the others by id.
std::vector<int> paired_members(const Pool& pool, const Lists& lists) {
  std::vector<int> members, others;
  for (std::size_t k = 0; k < pool.owned; ++k) {
    if (!lists.of(k).empty()) members.push_back(static_cast<int>(k));
  }
  std::vector<bool> seen(pool.members.size());
  for (const int partner : lists.partners) {
    if (partner >= static_cast<int>(pool.owned) && !seen[partner]) others.push_back(partner);
    seen[partner] = true;
  }
  std::ranges::sort(others, {}, [&](int m) { return pool.members[m].id; });
  members.insert(members.end(), others.begin(), others.end());
  return members;
}

Pairs pairs_of(const Task& task, const Pool& pool, const Lists& lists) {
  Pairs pairs;
  pairs.one_body = task.parties.one_body;
  std::vector<int> local(pool.members.size(), -1);
  for (const int m : paired_members(pool, lists)) {
    const Candidate& member = pool.members[m];
    local[m] = static_cast<int>(pairs.sites.size());
    pairs.sites.push_back(site(member));
    pairs.masses.push_back(member.mass);
    pairs.ids.push_back(member.id);
    if (m >= static_cast<int>(pool.owned)) continue;
    pairs.owned.push_back(static_cast<int>(member.owned));
    pairs.start.push_back(pairs.start.back() + lists.of(m).size());
  }
  for (const int partner : lists.partners) pairs.partners.push_back(local[partner]);
  const auto first_other = pairs.ids.begin() + static_cast<std::ptrdiff_t>(pairs.owned.size());
  const std::vector<std::int64_t> owned(pairs.ids.begin(), first_other), others(first_other, pairs.ids.end());
  if (task.communicator().sum(static_cast<std::int64_t>(others.size())) > 0) {
    pairs.halo.emplace(task.communicator(), owned, others);
  }
  return pairs;
}

// Where the moved points of each party are, over all ranks.
struct Centres {
  std::vector<Vector> of_first, of_second;  // where a party meets itself, all are of the second
};

Centres centres_of(const Task& task, const std::vector<int>& moved) {
  using Record = std::array<double, 4>;
  Centres centres;
  const auto add = [&centres](const Vector& x, bool is_first) {
    (is_first ? centres.of_first : centres.of_second).push_back(x);
  };
  std::vector<Vector> places;
  std::vector<Record> records;
  for (const int k : moved) {
    const Vector& x = places.emplace_back(task.places[k]);
    const bool is_first = task.block(k) == task.parties.first && !task.parties.self();
    records.push_back({x[0], x[1], x[2], is_first ? 1.0 : 0.0});
    add(x, is_first);
  }
  for (const Record& x :
       from_near_ranks<Record>(box_around(task.places), places, records, task.reach(), task.communicator())) {
    add({x[0], x[1], x[2]}, x[3] > 0);
  }
  return centres;
}

// Whether a place is near any of some.
class Nearness {
 public:
  Nearness(const std::vector<Vector>& centres, double reach)
      : grid_(centres, reach), box_(box_around(centres)), reach2_(reach * reach) {}
  bool operator()(const Vector& x) const {
    if (box_.isEmpty() || box_.squaredExteriorDistance(x) > reach2_) return false;
    bool near = false;
    grid_.visit_near(x, [&](int, const Vector& centre) { near = near || (centre - x).squaredNorm() <= reach2_; });
    return near;
  }

 private:
  CellGrid grid_;
  Box box_;
  double reach2_;
};

// Owned points that a search about moved ones has to know, as indices of parties.points: these, those near any moved
// one of the other party and of any rank, and those that have partners already.
std::vector<int> points_about(const Task& task, const std::vector<int>& moved, const Pairs& pairs) {
  const Centres centres = centres_of(task, moved);
  const Nearness near_first(centres.of_first, task.reach()), near_second(centres.of_second, task.reach());
  std::vector<int> points;
  std::size_t paired = 0;
  auto next = moved.begin();
  for (int k = 0; k < static_cast<int>(task.places.size()); ++k) {
    const int i = task.parties.points[k];
    while (paired < pairs.owned.size() && pairs.owned[paired] < i) ++paired;
    const bool has_partners = paired < pairs.owned.size() && pairs.owned[paired] == i;
    const bool has_moved = next != moved.end() && *next == k;
    if (has_moved) ++next;
    const Nearness& near = task.block(k) == task.parties.first ? near_second : near_first;
    if (has_partners || has_moved || near(task.places[k])) points.push_back(k);
  }
  return points;
}

// What is known of the pair's partners on other ranks, for those that have gone out of the pool's reach.
Candidate remembered(const Pairs& pairs, std::size_t s) {
  Candidate c{};
  std::copy_n(pairs.sites[s].reference.data(), 4, c.reference);
  std::copy_n(pairs.sites[s].current.data(), 4, c.current);
  c.mass = pairs.masses[s];
  c.id = pairs.ids[s];
  return c;
}

// The pairs found before. Adds their members to the pool where it has not got them; it has all owned ones.
Lists old_lists(const Pairs& pairs, Pool& pool) {
  std::unordered_map<std::int64_t, int> index;
  for (std::size_t m = 0; m < pool.members.size(); ++m) index.emplace(pool.members[m].id, static_cast<int>(m));
  std::vector<int> members;
  for (std::size_t s = 0; s < pairs.ids.size(); ++s) {
    const auto [at, is_new] = index.emplace(pairs.ids[s], static_cast<int>(pool.members.size()));
    if (is_new) pool.add(remembered(pairs, s));
    members.push_back(at->second);
  }
  Lists lists;
  std::size_t old = 0;
  for (std::size_t k = 0; k < pool.owned; ++k) {
    if (old < pairs.owned.size() && pairs.owned[old] == pool.members[k].owned) {
      for (std::size_t p = pairs.start[old]; p < pairs.start[old + 1]; ++p) {
        lists.partners.push_back(members[pairs.partners[p]]);
      }
      ++old;
    }
    lists.close();
  }
  return lists;
}

}  // namespace

Pairs find_pairs(const Crowd& crowd, const Parties& parties, std::span<const Vector> places, const Model& model,
                 double skin) {
  const Task task{crowd, parties, places, model, skin};
  const Pool pool = pool_of(task, possible_points(task));
  return pairs_of(task, pool, lists_of(pool, all_pairs(pool, {model.radius, skin, parties}, task.reach())));
}

void renew_pairs(const Crowd& crowd, const Parties& parties, std::span<const Vector> places,
                 const std::vector<int>& moved, const Model& model, double skin, Pairs& pairs) {
  const Task task{crowd, parties, places, model, skin};
  Pool pool = pool_of(task, points_about(task, moved, pairs), moved);
  const Lists gained = lists_of(pool, pairs_of_moved(pool, {model.radius, skin, parties}, task.reach()));
  const Lists before = old_lists(pairs, pool);
  pairs = pairs_of(task, pool, merged(pool, gained, before));
}

double distance_of_boxes(const Crowd& crowd, const Parties& parties, std::span<const Vector> places) {
  const Box one = box_of(crowd, parties, places, parties.first), other = box_of(crowd, parties, places, parties.second);
  if (one.isEmpty() || other.isEmpty()) return std::numeric_limits<double>::infinity();
  return one.exteriorDistance(other);
}

}  // namespace strut::contact
