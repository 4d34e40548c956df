// A mesh as a stream of arrays from another program (tools/README.md has the format).
#pragma once

#include <istream>
#include <string>

#include "io/exodus/exodus.hpp"

namespace strut::mesh {

// Throws Error, with `source` in front, where the stream ends early or holds what is not a mesh. Memory is taken as
// data arrive, never because a count in a header says so.
// `summary`: lines about voxels that were gathered in cells.
io::Mesh read_arrays(std::istream& stream, const std::string& source, std::string* summary = nullptr);

}  // namespace strut::mesh
