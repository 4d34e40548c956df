// The lines of a recipe: entries of bodies, before they have a meaning (recipe.cpp).
#pragma once

#include <istream>
#include <map>
#include <string>
#include <vector>

namespace strut::mesh {

struct Entry {
  std::string value;
  int line = 0;
};

// The entries of one body.
struct Entries {
  int line;  // where it begins
  std::map<std::string, Entry> by_key = {};

  const Entry* find(const std::string& key) const {
    const auto place = by_key.find(key);
    return place == by_key.end() ? nullptr : &place->second;
  }
};

// The entries of each body, with those that stand before the first '[body]' as defaults. Adds a problem, which begins
// with the number of its line, for each line that is not one of `keys` with a value. Throws Error of one line if this
// is another kind of file: most of its first lines are no lines of a recipe.
std::vector<Entries> read_lines(std::istream& stream, const std::vector<std::string>& keys,
                                std::vector<std::string>& problems);

}  // namespace strut::mesh
