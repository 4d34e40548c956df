#include "contact/breaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>


namespace strut::contact {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

double distance(const Pairs& pairs, std::size_t k, std::size_t p) {
  return (pairs.sites[pairs.partners[p]].current - pairs.sites[k].current).head<3>().matrix().norm();
}

// Calls set(p) for each partner pairs.partners[p] of pairs.owned[k] that has one of these ids.
template <class Set>
void over_partners(const Pairs& pairs, std::size_t k, std::span<const std::int64_t> ids, const Set& set) {
  if (ids.empty()) return;
  for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
    if (std::find(ids.begin(), ids.end(), pairs.ids[pairs.partners[p]]) != ids.end()) set(p);
  }
}

}  // namespace

std::vector<int> places_in(const BlockPair& blocks, const Pairs& pairs) {
  std::vector<int> places;
  int at = 0;
  for (const int i : pairs.owned) {
    while (blocks.points[at] != i) ++at;
    places.push_back(at);
  }
  return places;
}

std::vector<std::int64_t> new_breaks(const Domain& domain, const BlockPair& blocks, int at, const BrokenCounts& before,
                                     const BrokenCounts& now) {
  const std::vector<int>& broken = domain.families.broken[blocks.points[at]];
  std::vector<std::int64_t> ids;
  for (std::size_t n = before.empty() ? 0 : before[at]; n < now[at]; ++n) ids.push_back(domain.id(broken[n]));
  return ids;
}

std::vector<PressedPair> pressed_pairs(const Pairs& pairs) {
  std::vector<PressedPair> pressed;
  for (std::size_t k = 0; k < pairs.owned.size() && !pairs.limits.empty(); ++k) {
    for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
      if (pairs.limits[p] != none) pressed.push_back({pairs.owned[k], pairs.ids[pairs.partners[p]], pairs.limits[p]});
    }
  }
  return pressed;
}

void set_limits(const Domain& domain, const BlockPair& blocks, double radius, const BrokenCounts& before,
                const BrokenCounts& now, std::span<const PressedPair> pressed, Pairs& pairs) {
  if (now.empty()) return;
  std::vector<std::pair<std::size_t, double>> limits;  // index of the partner, m
  for (const PressedPair& one : pressed) {
    const auto owner = std::ranges::lower_bound(pairs.owned, one.point);
    if (owner == pairs.owned.end() || *owner != one.point) continue;  // its partners are far away by now
    over_partners(pairs, owner - pairs.owned.begin(), {&one.partner, 1},
                  [&](std::size_t p) { limits.emplace_back(p, one.touching); });
  }
  const std::vector<int> places = places_in(blocks, pairs);
  for (std::size_t k = 0; k < places.size(); ++k) {
    over_partners(pairs, k, new_breaks(domain, blocks, places[k], before, now), [&](std::size_t p) {
      const Vector apart = (pairs.sites[pairs.partners[p]].reference - pairs.sites[k].reference).head<3>().matrix();
      const double now_apart = distance(pairs, k, p);
      if (now_apart < largest_touching_distance(radius, apart.norm(), true)) limits.emplace_back(p, now_apart);
    });
  }
  if (limits.empty()) return;
  pairs.limits.assign(pairs.partners.size(), none);
  for (const auto& [p, limit] : limits) pairs.limits[p] = limit;
}

void raise_limits(Pairs& pairs) {
  for (std::size_t k = 0; k < pairs.owned.size() && !pairs.limits.empty(); ++k) {
    for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
      if (pairs.limits[p] != none) pairs.limits[p] = std::max(pairs.limits[p], distance(pairs, k, p));
    }
  }
}

void serialize(Archive& archive, const Domain& domain, const BlockPair& blocks, std::vector<PressedPair>& pressed) {
  const std::size_t width = largest_whole_family(domain);
  std::vector<double> touching(blocks.points.size() * width, 0);  // in the order in which bonds broke; 0: not pressed
  for (const PressedPair& one : pressed) {
    const std::size_t at = std::ranges::lower_bound(blocks.points, one.point) - blocks.points.begin();
    const std::vector<int>& broken = domain.families.broken[one.point];
    const auto found = std::ranges::find(broken, one.partner, [&](int j) { return domain.id(j); });
    touching[at * width + (found - broken.begin())] = one.touching;
  }
  archive.field("pressed", static_cast<int>(width),
                [&](std::size_t at, int n) -> double& { return touching[at * width + n]; });
  if (!archive.loading()) return;
  pressed.clear();
  for (std::size_t at = 0; at < blocks.points.size(); ++at) {
    const int i = blocks.points[at];
    const std::vector<int>& broken = domain.families.broken[i];
    for (std::size_t n = 0; n < broken.size(); ++n) {
      const double here = touching[at * width + n];
      if (here > 0) pressed.push_back({i, domain.id(broken[n]), here});
    }
  }
}

}  // namespace strut::contact
