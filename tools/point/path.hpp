// The path of a material point: prescribed components over time. From a file, or uniaxial. Units: s, Pa, strain -.
#pragma once

#include <filesystem>
#include <vector>

#include "base/math/tensors.hpp"
#include "point_driver.hpp"

namespace strut::point {

struct Row {
  double time;
  Symmetric value;  // for each component the stress if it is prescribed, else the logarithmic strain
};

// Linear between rows. The first row is the unloaded start.
struct Path {
  StressPrescribed prescribed = all_strain;
  std::vector<Row> rows;
  int steps = 1;  // between two rows
};

// Along x at `rate` > 0 (1/s) to the strain `final`, which may be negative. The sides are held, or free of stress.
Path uniaxial(const StressPrescribed& prescribed, double rate, double final);

// Lines "time, xx, yy, zz, xy, yz, zx" after an optional header; empty lines and lines that start with # are skipped.
// Throws Error with file and line.
Path read_path(const std::filesystem::path& file, const StressPrescribed& prescribed);

}  // namespace strut::point
