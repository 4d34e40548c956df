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
  for (const int i : possible_points(crowd, parties, reach)) pool.members.push_back(candidate(crowd, i));
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

// Partners of the pool's owned members, as places in the pool, ordered by id.
struct Lists {
  std::vector<std::size_t> start{0};
  std::vector<int> partners;
};

Lists lists_of(const Pool& pool, const Criterion& may_touch, double reach) {
  const CellGrid grid(pool.places, reach);
  Lists lists;
  for (std::size_t k = 0; k < pool.owned; ++k) {
    const std::size_t begin = lists.partners.size();
    const Vector here = pool.places[k];
    grid.visit_near(here, [&](int other, const Vector& there) {
      const double distance2 = (there - here).squaredNorm();
      if (distance2 > reach * reach || other == static_cast<int>(k)) return;
      if (may_touch(pool.members[k], pool.members[other], distance2)) lists.partners.push_back(other);
    });
    std::sort(lists.partners.begin() + static_cast<std::ptrdiff_t>(begin), lists.partners.end(),
              [&](int a, int b) { return pool.members[a].id < pool.members[b].id; });
    lists.start.push_back(lists.partners.size());
  }
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
