// The extent of a cell beyond its point.
#pragma once

#include "topology/cloud.hpp"

namespace strut {

// The extent of the cell of point i, of this volume (m³), beyond the point in a direction of unit length, m. From the
// cell's moments: for a slab √3 times the root of its second moment. Without shapes in the cloud, that of a cube; 0 for
// a node, because nodes at a surface lie on it.
double reach_of_cell(const PointCloud& cloud, double volume, int i, const Vector& direction);

}  // namespace strut
