// How steeply the deformation gradient of a point follows the places of its family.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Of an owned point, 1/m²: V tr K⁻¹, its share in ω² by correspondence; by quadratic correspondence that of its cell.
// 0 of a point that carries no stress.
double steepness(const Body& body, int i);

}  // namespace strut
