// Helpers for tests of damaged and foreign files: the bytes of a file, the error of an action.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/errors.hpp"

namespace strut::io {

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The text of the Error, "" where there is none. Collective; the same on all ranks.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace strut::io
