// Overlapping meshes: material defined twice at one place.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. Warnings for points around which a body has more material than fits, and for blocks of different bodies
// inside each other. Coincident points are an error earlier (topology/coincident.hpp).
std::string overlaps(const Situation& situation);

}  // namespace strut
