// Members of a few spacings, families that are nearly flat, and the errors to expect of them.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A line for each block whose members are so thin that they lose a tenth of their bending stiffness, of
// ordinary points are off by a tenth in tension, or by quadratic correspondence may be off by a twentieth.
std::string thin_members(const Situation& situation);

// Collective. The warnings of blocks with points whose families nearly lie in a plane.
std::string flat_families(const Situation& situation);

// Collective. A warning for the blocks with points at nodes that touch by surfaces and are so narrow that the contact
// is weak everywhere.
std::string narrow_surfaces_of_nodes(const Situation& situation);

}  // namespace strut
