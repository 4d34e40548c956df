// What steps cost beside each other, as measured (docs/decisions.md, What subcycling costs): for the shares of ranks
// and the choice of substeps.
#pragma once

namespace strut {

// A step of a point by quadratic correspondence beside one by another formulation.
constexpr double cost_of_quadratic = 4;

}  // namespace strut
