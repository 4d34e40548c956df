// The edges of the cells of points, which need not be cubes.
#pragma once

#include "topology/domain.hpp"

namespace strut {

// True if the cell of an owned point has known edges: it is a hexahedron that is all material, or that of a node of
// hexahedra. The moments of tetrahedra and their nodes do not tell how far apart points are.
bool has_known_edges(const Domain& domain, int i);

// True if the volume of a point is that of a whole cell (not of nodes at a surface): only then its axes are certain.
bool has_whole_cell(const Domain& domain, int i);

// The edge of the cell of an owned point along a direction of unit length, m; exact for a box along its axes. A node at
// a surface has the edge of a node inside. The spacing if edges are not known.
double edge_of_cell(const Domain& domain, int i, const Vector& direction);

struct CellEdges {
  double shortest, longest;  // m
};

// Along the principal axes of the cell's moments.
CellEdges edges_of_cell(const Domain& domain, int i);

}  // namespace strut
