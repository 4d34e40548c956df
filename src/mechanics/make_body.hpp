// A body from its points and materials.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collective. Sets shape tensors, stabilization and the undeformed state. `materials`: one per block name of the cloud.
Body make_body(Domain domain, Influence influence, const std::vector<BlockMaterial>& materials);

// Memory of the points and bonds of this rank, bytes, for forecasts.
double footprint(const Body& body);

// Finds the points of a block on a lattice whose family differs from its stencil, because bonds of theirs have broken
// or cross a crack.
void set_off_stencil(const Domain& domain, MaterialBlock& block);

}  // namespace strut
