// Voxels from another program, as a stream (tools/README.md has the format), gathered in cells.
#pragma once

#include <istream>
#include <string>

#include "io/exodus/exodus.hpp"

namespace strut::mesh {

// Throws Error, beginning with `source`, if the stream ends early or does not describe a mesh. Memory is
// allocated as data arrive, never for a count in a header. `summary`: lines about voxels that were gathered in
// cells.
io::Mesh read_arrays(std::istream& stream, const std::string& source, std::string* summary = nullptr);

}  // namespace strut::mesh
