// How thin the members of a body are, and what a formulation keeps of their bending stiffness.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collective. 4 volume/surface of each block in spacings: of round and square rods their thickness, of plates twice
// that. Within a seventh where it is a hundred at most, else 0, of any mesh in any direction, for the surface is told
// by what is missing of the material around points. What blocks of one body have in common is no surface.
std::vector<double> thicknesses(const Domain& domain);

// The share of the bending stiffness that struts so many spacings thick keep by correspondence, by
// tests/reference/bench_thin_members (elements; mean gradient at a horizon of 1.75 spacings and of 3). 1 where nothing
// is known or nothing is lost. Quadratic correspondence: expected_error.hpp.
double bending_stiffness_kept(double horizon, double thickness);

// Young's modulus of bars so many spacings thick of ordinary points, in that of the material, as it was found; between
// what was measured, in between. Horizon in spacings. 1 where the members are thicker than what was measured.
double tension_stiffness_found(Influence influence, double horizon, double thickness);

}  // namespace strut
