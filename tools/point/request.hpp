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

// Throws Error that says what is wrong.
Request parse(const std::vector<std::string>& words);

}  // namespace strut::point
