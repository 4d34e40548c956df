// An open file's mesh.
#pragma once

#include "io/exodus.hpp"
#include "io/exodus_file.hpp"

namespace strut::io {

// See read_mesh (exodus.hpp).
Mesh mesh_of(const ExodusFile& file);

}  // namespace strut::io
