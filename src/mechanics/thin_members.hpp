// How thin the members of a body are, and how much of their stiffness a formulation retains.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collective. 4 volume/surface of each block, in spacings: the thickness of round and square rods, twice that of
// plates. Accurate to a seventh up to 100 spacings, else 0, for any mesh in any orientation: the surface follows from
// the material that is missing around points. Interfaces between blocks of one body, symmetry
// planes with images and periodic sides are no surface.
std::vector<double> thicknesses(const Domain& domain);

// The fraction of bending stiffness that struts `thickness` spacings thick retain by correspondence, measured by
// tests/reference/bench_thin_members (elements; mean gradient at a horizon of 1.75 spacings and of 3). 1 if unknown or
// if nothing is lost. Quadratic correspondence: expected_error.hpp.
double bending_stiffness_kept(Influence influence, double horizon, double thickness);

// Young's modulus of bars of ordinary points, `thickness` spacings thick, relative to the material's, as measured;
// linear between measurements. Horizon in spacings. 1 if the members are thicker than those measured.
double tension_stiffness_found(Influence influence, double horizon, double thickness);

}  // namespace strut
