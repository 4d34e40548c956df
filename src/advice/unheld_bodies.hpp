// Bodies of an equilibrium that nothing holds, or nothing but contact.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A warning for each piece of a scene of equilibria that contact may push along, as neither conditions nor
// what it is bonded to keep it from moving as a whole, or on which loads act that nothing at all holds. Tools that
// touch it at the start hold it along their normals.
std::string unheld_bodies(const Situation& situation);

}  // namespace strut
