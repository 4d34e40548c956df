// The contact search: pairs of points of two blocks (or of one) that are within a reach and not bonded.
#pragma once

#include "contact/search/pairs.hpp"
#include "contact/search/skin_distances.hpp"

namespace strut::contact {

// Collective. All pairs of the blocks that are not bonded and may touch before both ends have used up their skin
// distances. Increases the skin distances of points far from the other block as far as that allows. `radius`: r_c, m.
// `counts`: how many of the broken bonds of each owned point count as broken; empty: all.
Pairs find_pairs(const Kinematics& kinematics, const BlockPair& blocks, double radius, SkinDistances& skins,
                 const BrokenCounts& counts = {});

}  // namespace strut::contact
