#include "deck/sections/node_sets.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>

#include "base/numbers.hpp"
#include "deck/problems.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Node Sets";

const AnyKey<Function> where("Points at whose reference position (m) the expression is not zero, e.g. `z &lt; 1e-3`.");

}  // namespace

Section node_sets_section() {
  return {.name = name, .meaning = "Additional sets of points; each key is the name of one.", .any_key = where};
}

std::vector<NodeSet> read_node_sets(const Values& deck, Problems& problems) {
  const Values& values = deck.section(name);
  std::vector<NodeSet> sets;
  for (const auto& [set, points] : values.all(where)) {
    const std::string path = path_to(values.path(), set);
    if (set == "all") problems.add(path, "is the set of all points; expected another name");
    if (points.depends_on_time()) problems.add(path, "depends on t; expected an expression in x, y, z");
    sets.push_back({set, points});
  }
  return sets;
}

namespace {

namespace fs = std::filesystem;

const AnyKey<std::string> numbers_or_file(
    "A set of points in Peridigm's form: the name holds `Node Set`, the value is the numbers of elements (of points of "
    "a text file or grid) from 1, `1 4 7`, a file of them, relative to the deck's folder, or `nearest 0 0 0.1`, the "
    "point nearest to a position (m).");

// The place in "nearest x y z".
std::optional<Vector> nearest_place(const std::string& text) {
  const std::string word = "nearest ";
  const auto numbers = text.starts_with(word) ? to_reals(text.substr(word.size())) : std::nullopt;
  return numbers && numbers->size() == 3 ? std::optional<Vector>(Vector(numbers->data())) : std::nullopt;
}

// Meshes with numbers of 64 bits have some beyond those of an int.
std::optional<std::vector<std::int64_t>> numbers_in(const std::string& text) {
  std::vector<std::int64_t> numbers;
  for (const std::string& word : to_words(text)) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || number < 1) return std::nullopt;
    numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

// Lines that begin with #, / or * are comments, and PeriLab's that begins with "header:".
std::string without_comments(std::istream& file) {
  std::string text, line;
  while (std::getline(file, line)) {
    const std::string_view content = trimmed(text.empty() ? without_mark(line) : line);
    if (content.starts_with("header:")) continue;
    if (!content.empty() && std::string_view("#/*").find(content[0]) == std::string_view::npos)
      text += std::string(content) + " ";
  }
  return text;
}

}  // namespace

Key numbered_set() { return numbers_or_file; }

void add_numbered_sets(const Values& deck, const fs::path& deck_file, std::vector<NodeSet>& sets, Problems& problems) {
  const Values& values = deck.section(boundary_conditions);
  for (const auto& [name, text] : values.all(numbers_or_file)) {
    if (name.find("Node Set") == std::string::npos) {
      problems.add(path_to(values.path(), name),
                   "unknown key; expected sections, or sets of points by number, whose names hold 'Node Set'");
    }
    const auto numbers = numbers_in(text);
    NodeSet set;
    set.name = name;
    set.numbers = numbers.value_or(std::vector<std::int64_t>());
    set.nearest = nearest_place(text);
    if (!numbers && !set.nearest) set.file = deck_file.parent_path() / text;
    sets.push_back(set);
  }
}

void read_numbers(std::vector<NodeSet>& sets, Problems& problems) {
  for (NodeSet& set : sets) {
    if (set.file.empty()) continue;
    std::ifstream file;
    if (fs::is_regular_file(set.file)) file.open(set.file);  // opening a pipe would block
    const auto numbers = fs::is_regular_file(set.file) ? numbers_in(without_comments(file)) : std::nullopt;
    set.numbers = numbers.value_or(std::vector<std::int64_t>());
    if (!set.numbers->empty()) continue;
    const std::string text = set.file.filename().string();
    const bool from_zero = text.find_first_not_of("0123456789 \t\n") == std::string::npos;
    problems.add(path_to(boundary_conditions, set.name),
                 "'" + text + "' is neither a list of numbers, the first 1, nor a file of them in the deck's folder" +
                     (from_zero ? "; numbers from 0, as in the oldest decks of Peridigm, are one too small here" : ""));
  }
}

}  // namespace strut::deck
