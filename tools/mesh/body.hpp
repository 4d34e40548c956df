// The mesh of a body: a cross-section extruded along z in layers, the struts of a foam, or an existing mesh.
#pragma once

#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"
#include "mesh/recipe.hpp"

namespace strut::mesh {

// One block and its node sets "<name>_zmin", "<name>_zmax" (a box and a foam also have those of x and y), or the
// content of a file.
io::Mesh mesh_of(const Body& body, std::string& summary);

// The mesh of all bodies. The sets of a single one, but for a file's, also have plain names: foot (zmin) and top
// (zmax).
io::Mesh mesh_of(const std::vector<Body>& bodies, std::string& summary);

// Moves nodes and the data of elements.
void shift(io::Mesh& mesh, const Vector& by);

// Adds a body's mesh. Throws Error if one of its blocks or sets has a name that exists already.
void append(io::Mesh& mesh, const io::Mesh& body);

}  // namespace strut::mesh
