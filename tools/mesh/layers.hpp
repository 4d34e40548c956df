// The layers of a body that is extruded along z.
#pragma once

#include <vector>

#include "mesh/recipe.hpp"

namespace strut::mesh {

// Heights of the layers' faces over a body of this height (m), from 0 to it: equal layers, as thick as the spacing up
// to rounding; or graded ones, with the spacing over the length `uniform`, then each `grading` times as thick as the
// one below, up to `coarsest`; then all are scaled to fit the height.
std::vector<double> levels_of(const Body& body, double height);

}  // namespace strut::mesh
