// An open-cell foam: voxels around the edges of a tessellation.
#pragma once

#include <string>

#include "io/exodus/exodus.hpp"
#include "mesh/recipe.hpp"

namespace strut::mesh {

// One block and six node sets without names, the lower corner of the box at the origin. Throws Error where voxels are
// too coarse for connected struts of the wanted density, or the box does not hold a cell.
io::Mesh foam_mesh(const Body& body, std::string& summary);

}  // namespace strut::mesh
