// The layers of a body that is drawn along z.
#pragma once

#include <vector>

#include "mesh/recipe.hpp"

namespace strut::mesh {

// Heights of the layers' faces over a body of this height (m), from 0 to it: all layers alike, as thick as the spacing
// but for rounding; or graded. Graded ones have the spacing as their thickness over the length `uniform`, then each is
// `grading` times as thick as the one below, up to `coarsest`; then all are scaled to fit the height.
std::vector<double> levels_of(const Body& body, double height);

}  // namespace strut::mesh
