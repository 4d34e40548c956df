// The shape tensor of a family, and how strongly the deformation gradient depends on the positions in it.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// K = Σ ω V ξ⊗ξ over the present family of a point, without broken bonds, m⁵.
Tensor shape_tensor(const Body& body, int i);

// K⁻¹, 1/m⁵; zero if the bonds do not span space, up to round-off.
Symmetric inverse_of(const Tensor& K);

// V tr K⁻¹ of an owned point, 1/m²: its factor in ω² by correspondence; by quadratic correspondence V κ of its cell. It
// is 0 if the point carries no stress.
double steepness(const Body& body, int i);

// l² V tr S⁻¹ of an owned point, where S = Σ V ξ ⊗ ξ over its family, V is the volume of its whole cell and l = V^⅓. It
// is 0.3 or less inside a lattice and 1.3 at corners of two layers. If almost all neighbors lie in one plane it is
// (l/t)²/n: only the n others, at a mean distance t from the plane, determine F across it.
double flatness(const Domain& domain, int i);

}  // namespace strut
