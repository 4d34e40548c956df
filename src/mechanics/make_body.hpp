// A body from its points and materials.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collective. Shape tensors, stabilization and undeformed state. `materials`: one for each block name of the cloud.
Body make_body(Domain domain, Influence influence, const std::vector<BlockMaterial>& materials);

// Bytes that the points and bonds of this rank take, for predictions.
double footprint(const Body& body);

}  // namespace strut
