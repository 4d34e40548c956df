// The path of a material point: what is prescribed, and when. From a file, or uniaxial. Units: s, Pa, strain -.
#pragma once

#include <filesystem>
#include <vector>

#include "base/math/tensors.hpp"
#include "point_driver.hpp"

namespace strut::point {

struct Row {
  double time;
  Symmetric value;  // of each component the stress where that is prescribed, else the logarithmic strain
};

// Linear between rows. The first row is the unloaded start.
struct Path {
  StressPrescribed prescribed = all_strain;
  std::vector<Row> rows;
  int steps = 1;  // between two rows
};

// Along x at `rate` > 0 to the strain `final`, which may be negative. The sides are held, or free of stress.
Path uniaxial(const StressPrescribed& prescribed, double rate, double final);

// Lines "time, xx, yy, zz, xy, yz, zx" after a header, if any; empty lines and lines that start with # are skipped.
// Throws Error with file and line.
Path read_path(const std::filesystem::path& file, const StressPrescribed& prescribed);

}  // namespace strut::point
