// How far the body reaches beyond a point: where its cell ends.
#pragma once

#include "topology/cloud.hpp"

namespace strut {

// By how much the cell of point i, of this volume (m³), reaches beyond it in a direction of unit length, m. By the
// cell's moments: of a slab √3 times the root of its second moment. Where the cloud has no shapes, that of a cube; of a
// node 0, for those at a surface lie on it.
double reach_of_cell(const PointCloud& cloud, double volume, int i, const Vector& direction);

}  // namespace strut
