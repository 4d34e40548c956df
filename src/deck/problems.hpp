// The problems of a deck, collected while it is read, so that the user sees all of them at once. A second public header
// of deck: set-up also adds problems that only deck and mesh together show.
#pragma once

#include <string>
#include <vector>

namespace strut::deck {

class Problems {
 public:
  // `path`: "Blocks > foam > Horizon"; `what`: the value found and what was expected.
  void add(const std::string& path, const std::string& what) { add(path + ": " + what); }

  void add(const std::string& line);  // path and text in one; duplicates are dropped

  bool empty() const { return lines_.empty(); }
  const std::vector<std::string>& lines() const { return lines_; }
  // True if a problem concerns this path, or one within it.
  bool about(const std::string& path) const;

  // Accepted input that needs a note: "Contact > Search Radius has no effect here: …".
  void note(const std::string& path, const std::string& what) { notes_.push_back(path + " " + what); }
  const std::vector<std::string>& notes() const { return notes_; }

  // "taylor.xml: 2 problems", and a line for each; empty if there are none.
  std::string text(const std::string& file) const;

  // Throws one Error with this text, if there are any.
  void raise(const std::string& file) const;

 private:
  std::vector<std::string> lines_, notes_;
};

// "Blocks > foam"; the path of the whole deck is empty.
std::string path_to(const std::string& parent, const std::string& name);

}  // namespace strut::deck
