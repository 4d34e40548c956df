// Struts a few points thick, as points: square prisms and round cylinders of thickness 1 m along an axis through the
// origin, made of cubic cells that know their volume, centroid, second moments and surface.
#pragma once

#include <vector>

#include "topology/cloud.hpp"

namespace strut::reference {

// A square prism along z, `across` elements in thickness and `along` in length, points at elements or at nodes.
PointCloud square_prism(int across, int along, PointsAt at);
// The same, four times as long as thick.
inline PointCloud square_prism(int across, PointsAt at) { return square_prism(across, 4 * across, at); }

// How a cylinder lies in the grid of cells.
struct Placement {
  Vector axis;    // of unit length
  Vector offset;  // of the grid, cells, 0 to 1
};
// Spread evenly over all directions and offsets; the same on every machine, and the first ones whatever the count.
std::vector<Placement> random_placements(int count);

// Treatment of the cells that the surface cuts.
//   whole   those whose center is inside are full, the others empty
//   cut     each keeps what is inside, in 6³ parts; cells below 30 % go to the neighbor across a face with the most
enum class Cells { whole, cut };

// A cylinder of length 4 m in a grid of `across` cells per diameter, points at the centroids of what is in the cells.
PointCloud round_cylinder(int across, const Placement& placement, Cells cells);

}  // namespace strut::reference
