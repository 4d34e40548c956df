// Who may touch whom: the pairs of two blocks (or of one) that are nearer than a reach and not bonded.
#pragma once

#include "contact/search/pairs.hpp"
#include "contact/search/skin_distances.hpp"

namespace strut::contact {

// Collective. All pairs of the blocks that are not bonded and may touch before both ends have used up their skin
// distances. Those of points that are far from all of the other block become as large as that allows. `radius`: r_c, m.
// `counts`: of the bonds of each owned point that have broken, how many count as broken; empty: all.
Pairs find_pairs(const Kinematics& kinematics, const BlockPair& blocks, double radius, SkinDistances& skins,
                 const BrokenCounts& counts = {});

}  // namespace strut::contact
