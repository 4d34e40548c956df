// Material that is where other material is: meshes that overlap.
#pragma once

#include <cstdint>
#include <string>

#include "mechanics/body.hpp"

namespace strut {

// Collective. Warnings: of points around which a body has more material than fits, and of blocks of different bodies
// that lie inside each other. `pieces`: connected ones, of all bodies. Points at one place are an error before (points/coincident.hpp).
std::string overlaps(const Body& body, std::int64_t pieces);

}  // namespace strut
