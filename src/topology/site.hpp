// A material point as its neighbors read it.
#pragma once

#include "base/math/tensors.hpp"

namespace strut {

// What a bond or a contact reads of its far end: one cache line. Four lanes, so that a vector and a scalar travel
// together.
struct alignas(64) Site {
  Eigen::Array4d reference;  // X (m), V (m³)
  Eigen::Array4d current;    // y (m), δ (m)

  double volume() const { return reference[3]; }
  double horizon() const { return current[3]; }
};

}  // namespace strut
