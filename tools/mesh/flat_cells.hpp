// Cells whose neighbors hardly span space: they are cut into two layers, or merged.
#pragma once

#include "mesh/pieces.hpp"

namespace strut::mesh {

// The deformation of a cell follows from the motion of its neighbors. If these are all in one plane, as in a strut that
// a wall of the box cuts along its length, it is undetermined along the normal, and a run drops the cell. If the cells
// are cut in two along the normal, they are each other's neighbors on either side of the plane. Sets the cells from the
// pieces, and changes both where cells are flat.
void mend_flat_cells(const Material& material, const Gathering& gathering, Pieces& pieces, Cells& cells);

}  // namespace strut::mesh
