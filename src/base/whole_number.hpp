// Parses an integer from a word of a command line or of the environment.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace strut {

// nullopt if the word is anything else, or exceeds an int.
inline std::optional<int> whole_number(std::string_view word) {
  int number = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, problem] = std::from_chars(word.data(), end, number);
  if (problem != std::errc() || rest != end) return std::nullopt;
  return number;
}

}  // namespace strut
