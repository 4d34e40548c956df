// A body as a mesh: its cross-section, drawn along z in layers.
#pragma once

#include <string>

#include "io/exodus.hpp"
#include "mesh/recipe.hpp"

namespace strut::mesh {

// One block and its node sets "<name>_zmin", "<name>_zmax" (a box also has those of x and y).
io::Mesh mesh_of(const Body& body, std::string& summary);

// Adds a body's mesh.
void append(io::Mesh& mesh, const io::Mesh& body);

}  // namespace strut::mesh
