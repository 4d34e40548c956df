#include "contact/search/search.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "base/errors.hpp"
#include "contact/search/clusters.hpp"
#include "contact/search/pairs.hpp"
#include "topology/bounding_box.hpp"
#include "topology/mirror_planes.hpp"
#include "topology/nearby_ranks.hpp"

namespace strut::contact {

namespace {

using Box = Eigen::AlignedBox3d;

Candidate candidate(const Kinematics& kinematics, int i, double skin) {
  const Site& site = kinematics.domain.sites[i];
  Candidate c{};
  std::copy_n(site.reference.data(), 4, c.reference);
  std::copy_n(site.current.data(), 4, c.current);
  c.mass = kinematics.densities[i] * site.volume();
  c.skin = skin;
  c.id = kinematics.domain.cloud.ids[i];
  c.block = kinematics.domain.cloud.blocks[i];
  c.owned = i;
  c.owner = kinematics.domain.communicator.rank();
  return c;
}

Site site(const Candidate& c) {
  Site site;
  std::copy_n(c.reference, 4, site.reference.data());
  std::copy_n(c.current, 4, site.current.data());
  return site;
}

// The images of points one period away, with the ids that the domain gives them (Images::id).
Images images_in_contact(const Domain& domain) { return domain.periods.empty() ? Images() : Images(domain.periods, 0); }

// The box of the points of a block over all ranks.
Box box_of(const Kinematics& kinematics, const BlockPair& blocks, int block) {
  Box mine;
  for (const int i : blocks.points) {
    if (kinematics.domain.cloud.blocks[i] == block) mine.extend(kinematics.domain.current(i));
  }
  return common_box(mine, kinematics.domain.communicator);
}

// The points, as indices of blocks.points, that may have a partner: those near the box of the other block. Sets the
// skin distance of each other point, at the distance D from that box: half of D − r_c, or D − r_c − skins.largest if
// less.
std::vector<int> near_points(const Kinematics& kinematics, const BlockPair& blocks, double radius,
                             SkinDistances& skins) {
  std::vector<int> near(blocks.points.size());
  std::iota(near.begin(), near.end(), 0);
  if (blocks.self() || !kinematics.domain.periods.empty()) return near;
  const Box first = box_of(kinematics, blocks, blocks.first), second = box_of(kinematics, blocks, blocks.second);
  std::erase_if(near, [&](int k) {
    const int i = blocks.points[k];
    const Box& others = kinematics.domain.cloud.blocks[i] == blocks.first ? second : first;
    const double gap = others.isEmpty() ? std::numeric_limits<double>::infinity()
                                        : others.exteriorDistance(kinematics.domain.current(i)) - radius;
    if (gap <= skins.of[k] + skins.largest) return false;
    skins.of[k] = static_cast<float>((1 - 1e-6) * std::min({gap / 2, gap - skins.largest, 1e30}));  // rounding
    return true;
  });
  return near;
}

// The images behind periodic sides of these candidates, where they are now.
std::vector<Candidate> images_of(std::span<const Candidate> candidates, const Domain& domain, const Images& images) {
  std::vector<Candidate> all;
  for (const int image : images.of_body(0)) {
    const Reflection &by = images[image], now = by.stretched(domain.halo.stretch());
    for (Candidate c : candidates) {
      Eigen::Map<Vector>(c.reference) += by.shift;
      Eigen::Map<Vector>(c.current) += now.shift;
      c.id = Images::id(c.id, image);
      all.push_back(c);
    }
  }
  return all;
}

// Collective. Throws Error if points are so far apart that images more than one period away may be near.
void check_extent(const Domain& domain, const std::vector<Vector>& places, double reach) {
  const Vector extent = common_box(box_around(places), domain.communicator).sizes();
  for (const Period& period : domain.periods) {
    const double length = period.length * domain.halo.stretch()[period.axis];
    if (!(extent[period.axis] + reach > 2 * length)) continue;
    throw Error("contact across periodic sides: points are " + std::to_string(extent[period.axis] / length) +
                " periods apart along " + "xyz"[period.axis] +
                "; contact knows images one period away, enough for points less than two periods apart");
  }
}

// The points blocks.points[k], k in `near`, and those near them on other ranks or behind periodic sides.
CandidatePool candidates_of(const Kinematics& kinematics, const BlockPair& blocks, const std::vector<int>& near,
                            const SkinDistances& skins, double radius) {
  CandidatePool candidates;
  std::vector<Vector> places;
  candidates.members.reserve(near.size());
  for (const int k : near) {
    candidates.members.push_back(candidate(kinematics, blocks.points[k], skins.of[k]));
    places.push_back(place(candidates.members.back()));
  }
  candidates.owned = candidates.members.size();
  const double reach = (radius + 2 * skins.largest) * (1 + 1e-9);  // a pair at the limit is found by both ranks
  const Domain& domain = kinematics.domain;
  if (!domain.periods.empty()) check_extent(domain, places, reach);
  const Eigen::AlignedBox3d mine = box_around(places);
  std::vector<Candidate> offered = candidates.members;
  const std::vector<Candidate> images = images_of(offered, domain, images_in_contact(domain));
  offered.insert(offered.end(), images.begin(), images.end());
  for (const Candidate& image : images) places.push_back(place(image));
  const auto others = from_nearby_ranks<Candidate>(mine, places, offered, reach, domain.communicator);
  candidates.members.insert(candidates.members.end(), others.begin(), others.end());
  std::ranges::copy_if(images, std::back_inserter(candidates.members), [&](const Candidate& image) {
    return !mine.isEmpty() && mine.exteriorDistance(place(image)) <= reach;
  });
  return candidates;
}

// A list of candidates for each of some candidates.
struct Lists {
  std::vector<std::size_t> start;
  std::vector<int> members;

  auto of(std::size_t k) const { return std::span(members).subspan(start[k], start[k + 1] - start[k]); }
};

// Lists for `count` candidates, filled in the order in which for_each(visit) calls visit(k, member of list k).
template <class ForEach>
Lists lists_from(std::size_t count, const ForEach& for_each) {
  Lists lists{std::vector<std::size_t>(count + 1, 0), {}};
  for_each([&](int k, int) { ++lists.start[k + 1]; });
  std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
  lists.members.resize(lists.start.back());
  std::vector<std::size_t> next(lists.start.begin(), lists.start.end() - 1);
  for_each([&](int k, int member) { lists.members[next[k]++] = member; });
  return lists;
}

// Partners of the owned candidates, ordered by id, because all partners are visited in this order.
Lists lists_of(const CandidatePool& candidates, const IndexPairs& pairs) {
  const Lists owned = lists_from(candidates.members.size(), [&](const auto& visit) {
    for (const auto& [k, partner] : pairs) visit(partner, k);
  });
  std::vector<int> partners;
  for (std::size_t m = 0; m < candidates.members.size(); ++m) {
    if (!owned.of(m).empty()) partners.push_back(static_cast<int>(m));
  }
  std::ranges::sort(partners, {}, [&](int m) { return candidates.members[m].id; });
  return lists_from(candidates.owned, [&](const auto& visit) {
    for (const int partner : partners) {
      for (const int k : owned.of(partner)) visit(k, partner);
    }
  });
}

// The candidates that are in a pair: owned ones, then the others by id.
std::vector<int> paired_members(const CandidatePool& candidates, const Lists& lists) {
  std::vector<int> members, others;
  for (std::size_t k = 0; k < candidates.owned; ++k) {
    if (!lists.of(k).empty()) members.push_back(static_cast<int>(k));
  }
  std::vector<bool> seen(candidates.members.size());
  for (const int partner : lists.members) {
    if (!candidates.owns(partner) && !seen[partner]) others.push_back(partner);
    seen[partner] = true;
  }
  std::ranges::sort(others, {}, [&](int m) { return candidates.members[m].id; });
  members.insert(members.end(), others.begin(), others.end());
  return members;
}

Pairs pairs_of(const CandidatePool& candidates, const Lists& lists, bool one_body, const Domain& domain) {
  const Communicator& communicator = domain.communicator;
  Pairs pairs;
  pairs.one_body = one_body;
  std::vector<int> owners;  // of the others
  std::vector<int> local(candidates.members.size(), -1);
  for (const int m : paired_members(candidates, lists)) {
    const Candidate& member = candidates.members[m];
    local[m] = static_cast<int>(pairs.sites.size());
    pairs.sites.push_back(site(member));
    pairs.masses.push_back(member.mass);
    pairs.ids.push_back(member.id);
    if (!candidates.owns(m)) {
      owners.push_back(static_cast<int>(member.owner));
      continue;
    }
    pairs.owned.push_back(member.owned);
    pairs.start.push_back(pairs.start.back() + lists.of(m).size());
  }
  for (const int partner : lists.members) pairs.partners.push_back(local[partner]);
  const std::span<const std::int64_t> ids(pairs.ids);
  if (communicator.sum(static_cast<std::int64_t>(owners.size())) > 0) {
    pairs.halo.emplace(communicator, ids.first(pairs.owned.size()), ids.subspan(pairs.owned.size()), owners,
                       images_in_contact(domain));
  }
  return pairs;
}

// For each site and axis, the number of periods by which an image is above its original.
std::vector<Vector> periods_above(const Pairs& pairs, const Domain& domain) {
  std::vector<Vector> above;
  if (domain.periods.empty()) return above;
  const Images images = images_in_contact(domain);
  for (const std::int64_t id : pairs.ids) {
    above.emplace_back(Vector::Zero());
    const Reflection& by = images[Images::image(id)];
    for (const Period& period : domain.periods) above.back()[period.axis] = strut::periods_above(by, period);
  }
  return above;
}

// Calls visit(i, id) for owned points and the points that broken bonds or a crack separate from them: the search by
// clusters leaves these pairs out.
template <class Visit>
void over_separated(const Domain& domain, const BrokenCounts& counts, const Visit& visit) {
  for (std::size_t i = 0; i < domain.families.broken.size(); ++i) {
    const std::vector<int>& broken = domain.families.broken[i];
    const std::size_t count = counts.empty() ? broken.size() : counts[i];
    for (std::size_t n = 0; n < count; ++n) visit(static_cast<int>(i), domain.id(broken[n]));
  }
  for (const auto& [i, id] : domain.separated) visit(i, id);
}

void add_separated_pairs(const Domain& domain, const BrokenCounts& counts, const CandidatePool& candidates,
                         const Criterion& may_touch, IndexPairs& pairs) {
  if (!may_touch.blocks.one_body || (domain.families.broken.empty() && domain.separated.empty())) return;
  std::unordered_map<std::int64_t, int> index;
  for (std::size_t m = 0; m < candidates.members.size(); ++m) {
    index.emplace(candidates.members[m].id, static_cast<int>(m));
  }
  over_separated(domain, counts, [&](int i, std::int64_t id) {
    const auto here = index.find(domain.id(i)), there = index.find(id);
    if (here == index.end() || there == index.end()) return;  // far away, or in a third block
    const Candidate &one = candidates.members[here->second], &other = candidates.members[there->second];
    const bool of_both = may_touch.blocks.self() || one.block != other.block;
    if (of_both && may_touch.within_reach(one, other)) pairs.emplace_back(here->second, there->second);
  });
}

}  // namespace

Pairs find_pairs(const Kinematics& kinematics, const BlockPair& blocks, double radius, SkinDistances& skins,
                 const BrokenCounts& counts) {
  const std::vector<int> near = near_points(kinematics, blocks, radius, skins);
  const CandidatePool candidates = candidates_of(kinematics, blocks, near, skins, radius);
  const Criterion may_touch{radius, blocks};
  IndexPairs found = pairs_in(candidates, may_touch);
  add_separated_pairs(kinematics.domain, counts, candidates, may_touch, found);
  const Lists lists = lists_of(candidates, found);
  Pairs pairs = pairs_of(candidates, lists, blocks.one_body, kinematics.domain);
  pairs.above = periods_above(pairs, kinematics.domain);
  return pairs;
}

void bring_to_present(const Kinematics& kinematics, Pairs& pairs) {
  for (std::size_t k = 0; k < pairs.owned.size(); ++k)
    pairs.sites[k].current = kinematics.domain.sites[pairs.owned[k]].current;
  if (!pairs.halo) return;
  pairs.halo->set_stretch(kinematics.domain.halo.stretch());
  pairs.halo->exchange_positions(pairs.sites);
}

}  // namespace strut::contact
