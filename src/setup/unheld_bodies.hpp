// Bodies of an equilibrium that nothing holds, or nothing but contact.
#pragma once

#include <string>
#include <vector>

#include "contact/contact.hpp"
#include "setup/scene.hpp"

namespace strut {

// Collective. A warning for each piece of a scene of equilibria that contact may push along, as neither conditions nor
// what it is bonded to keep it from moving as a whole, or on which loads act that nothing at all holds. Tools that
// touch it at `start` (s) hold it along their normals; `step`: of the load, s.
std::string unheld_bodies(const Scene& scene, const std::vector<contact::Interaction>& interactions, double start,
                          double step);

}  // namespace strut
