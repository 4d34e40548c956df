// Cracks across plates a few layers thick.
#pragma once

#include <cstddef>

#include "mechanics/body.hpp"

namespace strut {

// For a block of ordinary points with a fracture energy: energy that a flat cut across a plate of so many layers
// dissipates, over the fracture energy. The critical value of the block is that of a lattice without faces.
double part_in_plates(const Body& body, std::size_t block, int layers);

}  // namespace strut
