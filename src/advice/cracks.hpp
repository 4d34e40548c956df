// Blocks whose bonds break: what their cracks lack.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// A line for each block whose points fail without softening, as its fracture energy is too small for its spacing.
std::string sudden_failure(const Situation& situation);

// A warning for each block whose bonds break by quadratic correspondence.
std::string noisy_cracks(const Situation& situation);

// A line for each block whose bonds break by their energy and, several in a step, may give some.
std::string breaks_under_pressure(const Situation& situation);

}  // namespace strut
