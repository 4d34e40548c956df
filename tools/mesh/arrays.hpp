// Voxels from another program, as a stream, gathered in cells.
//
// The stream is `strut-mesh arrays 1`, `nodes 0`, any number of bodies, `end`: lines that end with a newline. A body is
// a line, followed by little-endian numbers:
//   voxels NAME COUNT NX NY NZ N SMALLEST KIND [THICKNESS]
//   6 float64: edges of a voxel and the lower corner of the box in m
//   COUNT × 3 int32: indices i j k of solid voxels, ascending, i fastest
//   COUNT float64, only for KIND grey (else solid), > 0 to 1: how much of each is solid
// N³ voxels (1 to 16) are a cell; SMALLEST is `smallest_cell` of a recipe; with a THICKNESS of struts, in voxels, the
// expected error is printed. Faces of the box that the solid touches become node sets `NAME_zmin` and so on.
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
