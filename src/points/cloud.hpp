// The material points of one rank, as a reader delivers them and as the partition hands them on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/tensors.hpp"

namespace strut {

struct PointCloud {
  // One entry a point.
  std::vector<std::int64_t> ids;          // 0-based place in the file's order: unique over all ranks
  std::vector<std::int64_t> element_ids;  // the mesh's own number of the element
  std::vector<Vector> positions;          // reference position X, m
  std::vector<double> volumes;            // m³
  std::vector<int> blocks;                // index into block_names
  std::vector<std::uint64_t> sets;        // bit k: the point is in node set set_names[k]

  // The same on all ranks.
  std::vector<std::string> block_names;
  std::vector<std::string> set_names;  // at most 64

  std::size_t size() const { return ids.size(); }
};

}  // namespace strut
