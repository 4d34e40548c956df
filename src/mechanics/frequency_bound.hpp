// Upper bounds for the frequencies of points, which limit the critical time step.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Approximate bound for the part of block.points[k]'s stress in ω: √(M J V tr K⁻¹/(3ρ)) ‖F⁻¹‖, M = λ + 2μ; 1/s.
double frequency_bound(const Body& body, const MaterialBlock& block, int k);

// The bounds of all owned points, 1/s.
std::vector<double> frequency_bounds(const Body& body);

// The largest bound of a block's points on this rank, each times the point's fraction of the step, 1/s.
double largest_frequency_bound(const Body& body, const MaterialBlock& block);

}  // namespace strut
