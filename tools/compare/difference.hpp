// The difference of two series within a tolerance.
#pragma once

#include <string>
#include <vector>

#include "compare/series.hpp"

namespace strut::compare {

// Values may differ by the larger of `absolute` and `relative` times the largest magnitude, in either result, of that
// quantity over the frame. The components of a vector or tensor (names that end in X, Y, Z, XX, XY, …) are one
// quantity: a shear stress that is zero up to round-off is compared with the scale of the stress.
struct Tolerance {
  double relative = 1e-9;
  double absolute = 0;
};

struct Difference {
  std::string name;
  double absolute = 0;  // the largest, at `frame` and `index`
  double relative = 0;  // the largest of |a - b| / (magnitude over the frame)
  std::size_t frame = 0;
  std::size_t index = 0;
  std::string place;  // the entity that `index` counts
  bool within = true;
};

// The differences of all common variables over the common frames. NaN equals NaN, and differs infinitely from a
// number.
std::vector<Difference> differences(const Series& a, const Series& b, const Tolerance& tolerance);

// Differences of structure: number of frames, their times, names, numbers of entities.
std::vector<std::string> mismatches(const Series& a, const Series& b, const Tolerance& tolerance);

}  // namespace strut::compare
