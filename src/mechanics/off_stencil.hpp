// Points on a lattice whose family differs from its stencil, because bonds of theirs have broken or cross a crack.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Finds these points of a block on a lattice by its present families.
void set_off_stencil(const Domain& domain, MaterialBlock& block);

}  // namespace strut
