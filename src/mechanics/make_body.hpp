// A body from its points and materials.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collective. Shape tensors, stabilization and undeformed state. `materials`: one for each block name of the cloud.
Body make_body(Domain domain, Influence influence, const std::vector<BlockMaterial>& materials);

// Collects the points of a block on a lattice who have lost bonds, as Families has them now.
void set_off_stencil(const Domain& domain, MaterialBlock& block);

// Bytes that the points and bonds of this rank take, for predictions.
double footprint(const Body& body);

}  // namespace strut
