// Bodies of an equilibrium that nothing holds, or only contact.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A warning for each piece of a scene of equilibria that contact may push along, because neither conditions
// nor bonds prevent its rigid motion, or that nothing holds while loads act on it. Tools that touch it at the start
// hold it along their normals.
std::string unheld_bodies(const Situation& situation);

}  // namespace strut
