// A body as a mesh: a cross-section drawn along z in layers, the struts of a foam, or a mesh that is there.
#pragma once

#include <string>

#include "io/exodus/exodus.hpp"
#include "mesh/recipe.hpp"

namespace strut::mesh {

// One block and its node sets "<name>_zmin", "<name>_zmax" (a box and a foam also have those of x and y), or what a
// file holds.
io::Mesh mesh_of(const Body& body, std::string& summary);

// Moves nodes and what elements hold.
void shift(io::Mesh& mesh, const Vector& by);

// Adds a body's mesh. Throws Error where a block or set of it has a name that is taken.
void append(io::Mesh& mesh, const io::Mesh& body);

}  // namespace strut::mesh
