// Material that is where other material is: meshes that overlap.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. Warnings: of points around which a body has more material than fits, and of blocks of different bodies
// that lie inside each other. Points at one place are an error before (topology/coincident.hpp).
std::string overlaps(const Situation& situation);

}  // namespace strut
