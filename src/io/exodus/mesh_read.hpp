// An open file's mesh.
#pragma once

#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"

namespace strut::io {

// See read_mesh (exodus.hpp).
Mesh mesh_of(const ExodusFile& file);

// What partial_cell_attributes[attribute] is the name of.
double& member(PartialCell& cell, std::size_t attribute);

}  // namespace strut::io
