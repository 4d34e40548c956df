// The shape tensor of the present family, without broken bonds.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// K = Σ ω V ξ⊗ξ over the present family of a point, m⁵.
Tensor shape_tensor(const Body& body, int i);

// K⁻¹, 1/m⁵; zero if the bonds do not span space, up to round-off.
Symmetric inverse_of(const Tensor& K);

}  // namespace strut
