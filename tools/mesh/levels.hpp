// Bodies as levels: a number at each voxel, below which it is solid. The level that gives the wanted density is the
// radius of struts, half the thickness of sheets, or a value of a field.
#pragma once

#include <functional>
#include <vector>

#include "mesh/tessellation.hpp"

namespace strut::mesh {

struct VoxelGrid;

struct Level {
  double value;
  int voxel;
};

// The section of struts along and across an edge; the level is the radius of a circle as large as the section in the
// middle.
struct StrutShape {
  double node = 1;              // radius at the nodes over that in the middle
  bool three_cornered = false;  // a Plateau border: three concave sides, with the corners in the films

  // The radius over that in the middle, at the fraction t of the edge: areas as measured on an aluminum foam of ERG
  // (Gong, Kyriakides & Jang, Int. J. Solids Struct. 42 (2005) 1355: 1 + x² + 96 x⁴, x from −1/2 to 1/2).
  double width(double t) const;
  // How far a section may reach from its edge, over the level.
  double reach() const;
};

// The levels of all voxels up to `most`: over the struts around the edges, with balls at their ends.
std::vector<Level> strut_levels(const std::vector<Edge>& edges, const StrutShape& shape, const VoxelGrid& grid,
                                double most);

// The levels of all voxels by a field: its values at their centers.
std::vector<Level> field_levels(const std::function<double(const Vector&)>& field, const VoxelGrid& grid);

}  // namespace strut::mesh
