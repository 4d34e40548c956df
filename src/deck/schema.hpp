// The schema of a deck, as data: keys and sections. Each key is declared once, beside its reader (sections/, laws/);
// checks, defaults and the reference page (inputs/KEYS.md) follow from it.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace strut::deck {

enum class Kind {
  real,
  integer,
  boolean,
  reals,   // "0 0.1 0.2", or an array of Teuchos
  vector,  // three reals: "0 0 1"
  text,
  choice,     // one of Key::choices
  axes,       // one or several of x, y, z: "z", "xyz"
  names,      // separated by blanks
  expression  // a number, or an expression in x, y, z, t
};

// The largest of the types of numbers of Teuchos that a kind accepts; it accepts the smaller ones, too.
enum class Numbers { none, integer, real, several };

struct KindFacts {
  const char *name, *expected;  // on the page, in messages
  Numbers numbers;
};
const KindFacts& facts_of(Kind kind);

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool with_low = true, with_high = true;

  bool contains(double value) const;
  std::string text() const;  // "> 0", "in (0, 1]", or "" if there is no limit
};
inline constexpr Range positive{.low = 0, .with_low = false};
inline constexpr Range not_negative{.low = 0};

// A message for a name that is not valid here but that users of other programs will try.
struct Hint {
  std::string name, text;
};

// Keys that are read are declared as a type of keys.hpp, which sets their kind and whether they are required.
struct Key {
  std::string name;
  Kind kind = Kind::real;
  std::string unit = {};  // "" for none
  Range range = {};       // of every number in the value
  std::vector<std::string> choices = {};
  std::optional<std::string> fallback = {};  // the default, as text of a deck
  bool required = false;
  std::string meaning = {};
  std::vector<Hint> hints = {};  // about choices
  std::string no_effect = {};    // reason, for keys that other programs need; reported if the value is not `fallback`
};

inline const char* const any_name = "(any name)";

struct Section {
  std::string name = {};  // any_name for sections that the user names
  bool required = false;
  std::string meaning = {};
  std::vector<Key> keys = {};
  std::optional<Key> any_key = {};  // for parameters that the user names
  std::vector<Section> sections = {};
  std::vector<Hint> hints = {};  // about keys and sections

  // If the key `selector` has the name of a case, the keys and sections of that case belong to this section, too.
  std::string selector = {};
  std::vector<Section> cases = {};
};

// `section` with the key `selector`, whose choices are the names of `cases`. Required unless it has a default.
Section with_cases(Section section, Key selector, std::vector<Section> cases);

// The sections of a table of cases, each in the member `schema` of an entry.
template <class Entry>
std::vector<Section> schemas_of(const std::vector<Entry>& entries) {
  std::vector<Section> all;
  for (const Entry& entry : entries) all.push_back(entry.schema);
  return all;
}

// "expected a real number > 0, in kg/m³"
std::string expected(const Key& key);

}  // namespace strut::deck
