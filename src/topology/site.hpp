// The part of a material point that its neighbors read.
#pragma once

#include "base/math/tensors.hpp"

namespace strut {

// Data that a bond or a contact reads of its far end: one cache line. Four lanes each, so that a vector and a scalar
// are loaded together.
struct alignas(64) Site {
  Eigen::Array4d reference;  // X (m), V (m³)
  Eigen::Array4d current;    // y (m), δ (m)

  double volume() const { return reference[3]; }
  double horizon() const { return current[3]; }
};

}  // namespace strut
