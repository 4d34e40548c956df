// Checks of declared contact: blocks that meet without it, that are bonded in spite of it, or that have mirror images.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// A warning for every two blocks without an interaction whose bounding boxes, moved with the initial and prescribed
// velocities of the start, overlap before the run ends; not for blocks that are bonded to each other. It is a forecast:
// bodies thrown at each other later are not found.
std::string undeclared_contacts(const Situation& situation);

// Collective. A warning for every two blocks of an interaction that are bonded to each other, because contact ignores
// bonded points; for interactions of all blocks, only if all these bonds bridge a gap.
std::string bonded_contacts(const Situation& situation);

// A warning for each symmetry plane behind which a body with contact continues as its mirror image.
std::string contact_at_mirrors(const Situation& situation);

}  // namespace strut
