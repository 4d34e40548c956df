#include "deck/problems.hpp"

#include "base/errors.hpp"

namespace strut::deck {

void Problems::raise(const std::string& file) const {
  if (lines_.empty()) return;
  const std::string count = lines_.size() == 1 ? "1 problem" : std::to_string(lines_.size()) + " problems";
  throw Error(file + ": " + count + "\n  " + joined(lines_, "\n  "));
}

std::string path_to(const std::string& parent, const std::string& name) {
  return parent.empty() ? name : parent + " > " + name;
}

}  // namespace strut::deck
