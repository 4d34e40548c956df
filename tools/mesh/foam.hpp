// Open-cell foams and lattices: voxels around the edges of a tessellation, or along a surface.
#pragma once

#include <string>

#include "io/exodus/exodus.hpp"
#include "mesh/recipe.hpp"

namespace strut::mesh {

// One block and six node sets without names, with the lower corner of the box at the origin. Throws Error if voxels are
// too coarse for connected struts of the wanted density, or if the box does not contain a foam cell.
io::Mesh foam_mesh(const Body& body, std::string& summary);

// The same of a lattice by its name (mesh/lattices.hpp).
io::Mesh lattice_mesh(const Body& body, std::string& summary);

// An indented line about `members` (struts) this many cells thick: the errors to expect in a run.
std::string resolution_of(const std::string& members, double cells);

}  // namespace strut::mesh
