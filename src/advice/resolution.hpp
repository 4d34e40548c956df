// Members a few spacings thick, nearly flat families, narrow surfaces of nodes, and the errors to expect.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A line for each block whose members are so thin that they lose a tenth of their bending stiffness, that
// ordinary points have an error of a tenth in tension, or quadratic correspondence possibly one of a twentieth.
std::string thin_members(const Situation& situation);

// Collective. The warnings of blocks with points whose families nearly lie in a plane.
std::string flat_families(const Situation& situation);

// Collective. A warning for the blocks with points at nodes that touch by surfaces and are so narrow that the contact
// is weak everywhere.
std::string narrow_surfaces_of_nodes(const Situation& situation);

}  // namespace strut
