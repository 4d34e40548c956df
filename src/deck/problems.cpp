#include "deck/problems.hpp"

#include <algorithm>

#include "base/errors.hpp"

namespace strut::deck {

void Problems::add(const std::string& line) {
  if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
}

bool Problems::about(const std::string& path) const {
  const auto is = [&](const std::string& line) {
    return line.starts_with(path + ": ") || line.starts_with(path + " > ");
  };
  return std::any_of(lines_.begin(), lines_.end(), is);
}

std::string Problems::text(const std::string& file) const {
  if (lines_.empty()) return "";
  const std::string count = lines_.size() == 1 ? "1 problem" : std::to_string(lines_.size()) + " problems";
  return file + ": " + count + "\n  " + joined(lines_, "\n  ");
}

void Problems::raise(const std::string& file) const {
  if (!lines_.empty()) throw Error(text(file));
}

std::string path_to(const std::string& parent, const std::string& name) {
  return parent.empty() ? name : parent + " > " + name;
}

}  // namespace strut::deck
