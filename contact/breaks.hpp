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

// Ids of the far ends of the bonds of blocks.points[at] that broke between two searches: `before` and `now` are the
// numbers of broken bonds that the former and the present search know.
// `before` may be empty: no search yet.
std::vector<std::int64_t> new_breaks(const Domain& domain, const BlockPair& blocks, int at, const BrokenCounts& before,
                                     const BrokenCounts& now);

// A pair whose bond broke while its points were nearer than points that touch. From then on its points press each other
// only when they are nearer than `touching`: a sudden pressure would be energy out of nothing.
struct PressedPair {
  int point = 0;             // owned, local index in the body
  std::int64_t partner = 0;  // its id
  double touching = 0;       // m, their distance at the break, or the largest that they have had since
};

// The pairs that have a limit in pairs.limits.
std::vector<PressedPair> pressed_pairs(const Pairs& pairs);

// Call it after a search. Sets pairs.limits: to `touching` for the pairs in `pressed`; to the present distance for
// pairs whose bonds have broken since the previous search. `radius`: r_c, m.
void set_limits(const Domain& domain, const BlockPair& blocks, double radius, const BrokenCounts& before,
                const BrokenCounts& now, std::span<const PressedPair> pressed, Pairs& pairs);

// Raises the limit of each pair whose points are farther apart than the limit to their present distance.
void raise_limits(Pairs& pairs);

// Collective. Saves or restores the pressed pairs, as columns of blocks.points.
void serialize(Archive& archive, const Domain& domain, const BlockPair& blocks, std::vector<PressedPair>& pressed);

}  // namespace strut::contact
