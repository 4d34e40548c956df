// The difference of two series within a tolerance.
#pragma once

#include <string>
#include <vector>

#include "compare/series.hpp"

namespace strut::compare {

// Values may differ by the larger of `absolute` and `relative` times the largest magnitude, in either result, of that
// quantity over the frame. The components of a vector or tensor (names that end in X, Y, Z, XX, XY, …) are one
// quantity: a shear stress that is zero but for rounding is measured against the stress.
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
  std::string place;  // what `index` counts
  bool within = true;
};

// Of all variables that both have, over the frames that both have. NaN equals NaN, and differs infinitely from a
// number.
std::vector<Difference> differences(const Series& a, const Series& b, const Tolerance& tolerance);

// What makes two series different before any value does: the number of frames, their times, names, numbers of places.
std::vector<std::string> mismatches(const Series& a, const Series& b, const Tolerance& tolerance);

}  // namespace strut::compare
