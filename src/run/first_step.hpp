// A check of the deck that needs the length of the first explicit step.
#pragma once

#include "integrators/explicit/step_length.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

// Collective. Throws Error if a user library is stiffer, e.g. by viscosity, in the first steps of its points than its
// elastic constants. `limit`: critical time step, s.
void check_libraries(const Body& body, const StepControl& control, double limit);

}  // namespace strut
