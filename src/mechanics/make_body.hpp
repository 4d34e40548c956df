// A body from its points and materials.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collective. Sets shape tensors, stabilization and the undeformed state. `materials`: one per block name of the cloud.
Body make_body(Domain domain, Influence influence, const std::vector<BlockMaterial>& materials);

// Memory of the points and bonds of this rank, bytes, for forecasts.
double footprint(const Body& body);

}  // namespace strut
