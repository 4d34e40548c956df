// Points whose bonds break while they are nearer than points that touch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/archive.hpp"
#include "contact/search/pairs.hpp"

namespace strut::contact {

// For each of pairs.owned its index in blocks.points.
std::vector<int> places_in(const BlockPair& blocks, const Pairs& pairs);

// Ids of the far ends of bonds of blocks.points[at] that a search knows to be broken and the search before it did not.
// `before` may be empty: no search yet.
std::vector<std::int64_t> new_breaks(const Domain& domain, const BlockPair& blocks, int at, const BrokenCounts& before,
                                     const BrokenCounts& now);

// A pair whose bond broke while its points were nearer than points that touch. They press each other only where they
// are nearer than they were then, or have been since: a sudden pressure would be energy out of nothing.
struct PressedPair {
  int point = 0;             // owned, local index in the body
  std::int64_t partner = 0;  // its id
  double touching = 0;       // the distance at which they touch, m
};

// Those of pairs.limits, by points and partners.
std::vector<PressedPair> pressed_pairs(const Pairs& pairs);

// Call it after a search. Sets pairs.limits: those of the pairs that were pressed before, and the present distances of
// points whose bonds this search is the first to know as broken. `radius`: r_c, m.
void set_limits(const Domain& domain, const BlockPair& blocks, double radius, const BrokenCounts& before,
                const BrokenCounts& now, std::span<const PressedPair> pressed, Pairs& pairs);

// Points that have moved apart touch at their present distance from now on.
void raise_limits(Pairs& pairs);

// Collective. Saves or restores them, as columns of blocks.points.
void serialize(Archive& archive, const Domain& domain, const BlockPair& blocks, std::vector<PressedPair>& pressed);

}  // namespace strut::contact
