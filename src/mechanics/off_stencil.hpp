// Points on a lattice whose family is not its stencil: bonds of theirs have broken, or were left out for a crack.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collects those of a block on a lattice, as Families has them now.
void set_off_stencil(const Domain& domain, MaterialBlock& block);

}  // namespace strut
