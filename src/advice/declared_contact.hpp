// Contact that the deck declares, and bodies: those that meet without it, are bonded all the same, or go on as images.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// A warning, a line each, for every two blocks without an interaction whose bounding boxes, moved on with
// the velocities of the start (initial and prescribed), overlap before the run is over. Blocks that are bonded
// to each other are no such pair. A forecast: who is thrown at somebody later is not seen.
std::string undeclared_contacts(const Situation& situation);

// Collective. A warning for every two blocks that an interaction names and that are bonded to each other, a body of
// which contact sees nothing where they are; of interactions of all blocks only where all these bonds bridge a gap.
std::string bonded_contacts(const Situation& situation);

// A warning for each symmetry plane at which a body with contact goes on as its mirror image.
std::string contact_at_mirrors(const Situation& situation);

}  // namespace strut
