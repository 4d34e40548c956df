// Small bodies.
#pragma once

#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"

namespace strut::fuzz {

// A box of 3 × 3 × 4 hexahedra of the edge `spacing` (m), its lower face at z, appended as a block. All sets hold the
// nodes of its lower face.
void add_box(io::Mesh& mesh, const std::string& block, double spacing, double z, const std::vector<std::string>& sets);

io::Mesh tetrahedra();
io::Mesh spheres();

}  // namespace strut::fuzz
