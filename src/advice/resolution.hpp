// Members a few spacings thick, and the errors to expect.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A line for each block whose members are so thin that they lose a tenth of their bending stiffness, that
// ordinary points have an error of a tenth in tension, or quadratic correspondence possibly one of a twentieth.
std::string thin_members(const Situation& situation);

}  // namespace strut
