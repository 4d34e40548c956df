// Fragments: sets of points that are connected by intact bonds (topology/pieces.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

struct Fragment {
  std::int64_t id = 0;                  // the least id of its points
  std::int64_t points = 0;              // number of points
  double mass = 0;                      // kg
  std::array<double, 3> velocity = {};  // of its center of mass, m/s
};

// Collective. All fragments on rank 0, the heaviest first; none on other ranks.
std::vector<Fragment> fragments(const Body& body);

}  // namespace strut
