// The command line of strut-point.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "point/path.hpp"

namespace strut::point {

struct Request {
  std::filesystem::path deck;
  std::string material;  // empty: the only one
  Path path;
};

// Throws Error with a description of the problem.
Request parse(const std::vector<std::string>& words);

}  // namespace strut::point
