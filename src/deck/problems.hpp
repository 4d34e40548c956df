// The problems found in a deck: collected while it is read, so that the user sees all of them at once.
#pragma once

#include <string>
#include <vector>

namespace strut::deck {

class Problems {
 public:
  // `path`: "Blocks > foam > Horizon"; `what`: the value found and what was expected.
  void add(const std::string& path, const std::string& what) { lines_.push_back(path + ": " + what); }

  // Throws one Error that lists every problem, if there are any.
  void raise(const std::string& file) const;

 private:
  std::vector<std::string> lines_;
};

// "Blocks > foam"; the path of the whole deck is empty.
std::string path_to(const std::string& parent, const std::string& name);

}  // namespace strut::deck
