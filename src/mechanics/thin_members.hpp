// How thin the members of a body are, and what a formulation keeps of their bending stiffness.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collective. 4 volume/surface of a block in spacings: of round and square rods their thickness, of plates twice that.
// 0 where the surface is not known: points that stand on no lattice or are not bonded to all around them, and bring no
// shapes. The surface is that of the cells where points have shapes; otherwise it is counted by Crofton's formula, from
// the directions to the 26 neighbors of a lattice in which there is none (weights: Ohser & Mücklich 2000).
double thickness_of(const Domain& domain, int block);

// The share of the bending stiffness that struts so many spacings thick keep, by tests/reference/bench_thin_members
// (elements; mean gradient at a horizon of 1.75 spacings and of 3; cells that know what is in them). 1 where nothing is
// known or nothing is lost.
double bending_stiffness_kept(Formulation formulation, double horizon, double thickness);

}  // namespace strut
