// The points of a node set or block, by its name.
#pragma once

#include <string>
#include <vector>

#include "topology/cloud.hpp"

namespace strut {

class PointGroup {
 public:
  PointGroup() = default;  // all points
  // A node set or a block, or `all`. Throws Error if there is neither, or both; `path`: deck path for the error.
  PointGroup(const PointCloud& cloud, const std::string& name, const std::string& path);

  bool counts(const PointCloud& cloud, int i) const {
    if (set_ >= 0) return (cloud.sets[i] >> set_ & 1) != 0;
    return block_ < 0 || cloud.blocks[i] == block_;
  }
  std::vector<int> points(const PointCloud& cloud) const;  // of this rank

 private:
  int set_ = -1, block_ = -1;  // both -1: all points
};

}  // namespace strut
