// How strongly the deformation gradient of a point depends on the positions of its family.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// V tr K⁻¹ of an owned point, 1/m²: its factor in ω² by correspondence; by quadratic correspondence V κ of its cell. It
// is 0 if the point carries no stress.
double steepness(const Body& body, int i);

}  // namespace strut
