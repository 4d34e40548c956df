// The symmetry planes that run through a point.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "points/domain.hpp"

namespace strut {

// Those of the body of an owned point.
inline std::vector<Mirror> planes_through(const Domain& domain, int i) {
  std::vector<Mirror> planes;
  std::ranges::copy_if(domain.mirrors, std::back_inserter(planes), [&](const Mirror& mirror) {
    return mirror.body == domain.blocks[domain.cloud.blocks[i]].body &&
           mirror.holds(domain.reference(i), domain.cloud.spacings[i]);
  });
  return planes;
}

}  // namespace strut
