// Points of tests that make their clouds one by one.
#pragma once

#include "topology/cloud.hpp"

namespace strut {

// Adds a point of block 0, in no node set. Its element has the number id + 1. m, m³.
inline void add_point(PointCloud& cloud, std::int64_t id, const Vector& place, double volume, double spacing) {
  cloud.ids.push_back(id);
  cloud.element_ids.push_back(id + 1);
  cloud.positions.push_back(place);
  cloud.volumes.push_back(volume);
  cloud.spacings.push_back(spacing);
  cloud.blocks.push_back(0);
  cloud.sets.push_back(0);
}

}  // namespace strut
