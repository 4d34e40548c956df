// Measured cost ratios of steps (docs/decisions.md, Cost of subcycling), for the partition weights and for the
// choice of substeps.
#pragma once

namespace strut {

// Cost of a step of a point by quadratic correspondence, relative to a point by another formulation.
constexpr double cost_of_quadratic = 4;

}  // namespace strut
