// The surface of a body, as surface contact needs it. The mesh gives two integrals over the surface of each cell
// (CellShape): they define a plane, and its change of direction from cell to cell gives the curvature. These give
//
// - the depth of a point below the surface, at which it touches another body;
// - the volume of a point in ρ. Before a curved surface, or a member thinner than the reach of ρ, ρ is smaller than
//   before a flat face; the volumes of the points behind it are raised by that ratio, so that contact starts at the
//   surface.
#pragma once

#include <vector>

#include "contact/search/pairs.hpp"
#include "topology/domain.hpp"

namespace strut::contact {

// True if a point may lie at the surface of its body: its family is one-sided (0.3 at a flat face, horizon 1.75
// spacings) or, in thin plates, incomplete (0.4 of the volume within the horizon; 0.94 or more inside a lattice). A
// false positive only costs time; no point at a surface may be missed.
bool is_at_surface(const Domain& domain, int i);

// Values for the points of two blocks, in the order of BlockPair::points.
struct OwnSurface {
  std::vector<double> depths;   // m; half a cell if the mesh has no surfaces
  std::vector<double> volumes;  // in ρ, m³
  std::vector<char> may_touch;  // the point is at the surface of the body
};

// Collective. In the reference state. `reach`: largest distance at which points see the other body, m.
OwnSurface own_surface(const Domain& domain, const BlockPair& blocks, double reach);

}  // namespace strut::contact
