// How fast the motion of a point can be: what limits the critical time step.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// A bound of what the stress of block.points[k] adds to ω, roughly: √(M J V tr K⁻¹/(3ρ)) ‖F⁻¹‖, M = λ + 2μ; 1/s.
double frequency_bound(const Body& body, const MaterialBlock& block, int k);

// The same of all owned points.
std::vector<double> frequency_bounds(const Body& body);

// Of the points of a block on this rank, as parts of their steps.
double largest_frequency_bound(const Body& body, const MaterialBlock& block);

}  // namespace strut
