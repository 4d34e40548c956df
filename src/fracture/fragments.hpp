// The connected pieces of a body: points that bonds lead to from each other.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

struct Fragment {
  std::int64_t id = 0;               // the least id of its points
  std::int64_t points = 0;           // how many
  double mass = 0;                   // kg
  Vector velocity = Vector::Zero();  // of its center of mass, m/s
};

// Collective. Of each owned point the id of its fragment.
std::vector<std::int64_t> fragment_ids(const Body& body);

// Collective. All of them on rank 0, the heaviest first; none on other ranks.
std::vector<Fragment> fragments(const Body& body);

}  // namespace strut
