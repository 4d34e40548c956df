// The keys of a deck as data. Each key is declared once (schema.cpp, laws.cpp, contact_laws.cpp, flow_stress.cpp);
// reading, checking, defaults and the reference page (inputs/KEYS.md) all follow from the declaration.
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
  names,      // separated by blanks
  expression  // a number, or an expression in x, y, z, t
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool with_low = true, with_high = true;

  bool contains(double value) const;
  std::string text() const;  // "> 0", "in (0, 1]", or "" for any number
};
inline const Range positive{.low = 0, .with_low = false};
inline const Range not_negative{.low = 0};

// What to tell about a name that is not valid here but that users of other programs will try.
struct Hint {
  std::string name, text;
};

struct Key {
  std::string name;
  Kind kind = Kind::real;
  std::string unit = {};  // "" for none
  Range range = {};       // of every number in the value
  std::vector<std::string> choices = {};
  std::optional<std::string> fallback = {};  // the default, as a deck would give it
  bool required = false;
  std::string meaning = {};
  std::vector<Hint> hints = {};  // about choices
  std::string no_effect = {};  // why, of keys that other programs need; told where the deck gives another than fallback
};

inline const char* const any_name = "(any name)";

struct Section {
  std::string name = {};  // any_name for sections that the user names
  bool required = false;
  std::string meaning = {};
  std::vector<Key> keys = {};
  std::optional<Key> any_key = {};  // what parameters are that the user names
  std::vector<Section> sections = {};
  std::vector<Hint> hints = {};  // about keys and sections

  // Where the key `selector` has the name of a case, the keys and sections of that case belong to this section too.
  std::string selector = {};
  std::vector<Section> cases = {};
};

// `section` with the key `selector`, whose choices are the names of `cases`.
Section with_cases(Section section, Key selector, std::vector<Section> cases);

// "expected a real number > 0, in kg/m³"
std::string expected(const Key& key);

// The schema of a whole deck.
const Section& schema();

}  // namespace strut::deck
