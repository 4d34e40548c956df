// The problems found in a deck: collected while it is read, so that the user sees all of them at once. A second public
// header of deck: set-up collects what only deck and mesh together show in the same way.
#pragma once

#include <string>
#include <vector>

namespace strut::deck {

class Problems {
 public:
  // `path`: "Blocks > foam > Horizon"; `what`: the value found and what was expected.
  void add(const std::string& path, const std::string& what) { add(path + ": " + what); }

  void add(const std::string& line);  // path and what in one; what has been said is not said again

  bool empty() const { return lines_.empty(); }
  const std::vector<std::string>& lines() const { return lines_; }
  // Whether any is of this path, or of one within it.
  bool about(const std::string& path) const;

  // What is accepted but told: "Contact > Search Radius has no effect here: …".
  void note(const std::string& path, const std::string& what) { notes_.push_back(path + " " + what); }
  const std::vector<std::string>& notes() const { return notes_; }

  // "taylor.xml: 2 problems", and a line for each; empty if there are none.
  std::string text(const std::string& file) const;

  // Throws one Error of this text, if there are any.
  void raise(const std::string& file) const;

 private:
  std::vector<std::string> lines_, notes_;
};

// "Blocks > foam"; the path of the whole deck is empty.
std::string path_to(const std::string& parent, const std::string& name);

}  // namespace strut::deck
