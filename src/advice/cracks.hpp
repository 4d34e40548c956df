// Warnings for blocks whose bonds break.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// A line for each block whose points fail without softening, because its fracture energy is too small for its spacing.
std::string sudden_failure(const Situation& situation);

// A warning for each block by quadratic correspondence whose bonds break.
std::string noisy_cracks(const Situation& situation);

// A line for each block whose bonds break by their energy, if several breaks in one step may create energy.
std::string breaks_under_pressure(const Situation& situation);

}  // namespace strut
