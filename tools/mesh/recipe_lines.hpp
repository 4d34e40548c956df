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

// The entries of one body, and their errors.
class Entries {
 public:
  explicit Entries(int line) : line_(line) {}

  int line() const { return line_; }
  void set(const std::string& key, Entry entry) { entries_[key] = std::move(entry); }
  const Entry* find(const std::string& key) const {
    const auto place = entries_.find(key);
    return place == entries_.end() ? nullptr : &place->second;
  }
  // Takes all of `defaults` that this does not have itself.
  void take_defaults(const Entries& defaults) { entries_.insert(defaults.entries_.begin(), defaults.entries_.end()); }

 private:
  int line_;
  std::map<std::string, Entry> entries_;
};

// The entries of each body, with those that stand before the first '[body]' as defaults. Adds a problem, which begins
// with the number of its line, for each line that is not one of `keys` with a value. Throws Error of one line if this
// is another kind of file: most of its first lines are no lines of a recipe.
std::vector<Entries> read_lines(std::istream& stream, const std::vector<std::string>& keys,
                                std::vector<std::string>& problems);

}  // namespace strut::mesh
