// The own surface of a body, as contact of surfaces needs it. A mesh tells the surface of each cell by two integrals
// (CellShape): a plane through it, and how these planes turn from cell to cell, its curvature. From them come
//
// - how deep a point lies below the surface: from there it touches another body;
// - the volume with which a point counts in ρ. Before a curved surface, or a member thinner than the reach of ρ, ρ is
//   less than before a flat face: by as much the volumes of the points there are larger, so that a surface is felt
//   where it is.
#pragma once

#include <vector>

#include "contact/search/pairs.hpp"

namespace strut::contact {

// Numbers of the points of two blocks, in the order of BlockPair::points.
struct OwnSurface {
  std::vector<double> depths;   // m; that of a half cell where the mesh tells nothing
  std::vector<double> volumes;  // in ρ, m³
  std::vector<char> may_touch;  // the body's surface is the point's
};

// Collective. In the reference state. `reach`: from how far points see the other body, m.
OwnSurface own_surface(const Domain& domain, const BlockPair& blocks, double reach);

}  // namespace strut::contact
