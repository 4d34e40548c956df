// The shape tensor of a family as it is now: bonds may have broken.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// K = Σ ω V ξ⊗ξ over the family that a point has now, m⁵.
Tensor shape_tensor(const Body& body, int i);

// K⁻¹; zero where the bonds do not span space, to round-off.
Symmetric inverse_of(const Tensor& K);

}  // namespace strut
