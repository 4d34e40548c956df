#include "mesh/recipe.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <variant>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/numbers.hpp"
#include "mesh/lattices.hpp"

namespace strut::mesh {

namespace {

constexpr double tiny = 1e-30, huge = 1e30;  // products of five are still numbers
constexpr double below_one = 1 - std::numeric_limits<double>::epsilon();
constexpr const char* a_length = "a length > 0 in m (1e-30 to 1e30)";

// Kinds of bodies, and groups of them that have a key in common.
enum Kind : unsigned {
  lattice_cylinder = 1,
  fitted_cylinder = 2,
  cone = 4,
  box = 8,
  foam = 16,
  lattice = 32,
  file = 64
};
constexpr unsigned round = lattice_cylinder | fitted_cylinder | cone;
constexpr unsigned of_struts = foam | lattice;
constexpr unsigned layered = fitted_cylinder | cone | box, gathered = lattice_cylinder | box | of_struts;
constexpr unsigned made = round | box | of_struts, any = made | file;

struct Key {
  const char* name;
  unsigned kinds;                                                          // that have it
  bool required = false;                                                   // by all of them
  const char* needs = nullptr;                                             // another key
  std::variant<double Body::*, int Body::*, Vector Body::*> numbers = {};  // one, a whole one, three
  double low = 0, high = 0;
  const char* expected = nullptr;
  const char* unless = nullptr;  // a key that a lattice may have in its place
};

const std::vector<Key> keys = {
    {"shape", any, true},
    {"method", made},
    {"name", any},
    {"elements", made},
    {"centred", lattice_cylinder},
    {"spacing", made, true, nullptr, &Body::spacing, tiny, huge, a_length},
    {"cells", gathered, false, nullptr, &Body::cells, 2, 16, "a whole number from 2 to 16"},
    {"smallest_cell", gathered, false, "cells", &Body::smallest_cell, 0, 0.9, "a number from 0 to 0.9"},
    {"grading", layered, false, nullptr, &Body::grading, 1, 2, "a number from 1 to 2"},
    {"uniform", layered, false, "grading", &Body::uniform, tiny, huge, a_length},
    {"coarsest", layered, false, "grading", &Body::coarsest, tiny, huge, a_length},
    {"length", round, true, nullptr, &Body::length, tiny, huge, a_length},
    {"radius", round, true, nullptr, &Body::radius, tiny, huge, a_length},
    {"top_radius", cone, true, nullptr, &Body::top_radius, tiny, huge, a_length},
    {"size", box | of_struts, true, nullptr, &Body::size, tiny, huge, "three lengths > 0 in m (1e-30 to 1e30)",
     "count"},
    {"cell", of_struts, true, nullptr, &Body::cell, tiny, huge, a_length},
    {"relative_density", of_struts, true, nullptr, &Body::relative_density, tiny, below_one, "a number between 0 and 1",
     "thickness"},
    {"periodic", of_struts},
    {"node_thickness", of_struts, false, nullptr, &Body::node_thickness, 1, 4, "a number from 1 to 4"},
    {"irregularity", foam, false, nullptr, &Body::irregularity, 0, 1, "a number from 0 to 1"},
    {"seed", foam},
    {"sizes", foam, false, nullptr, &Body::sizes, 0, 0.6, "a number from 0 to 0.6"},
    {"relax", foam, false, nullptr, &Body::relax, 0, 1000, "a whole number from 0 to 1000"},
    {"stretch", foam, false, nullptr, &Body::stretch, 0.2, 5, "three numbers from 0.2 to 5"},
    {"section", foam},
    {"lattice", lattice, true},
    {"count", lattice},
    {"thickness", lattice, false, nullptr, &Body::thickness, tiny, huge, a_length},
    {"file", file, true},
    {"origin", any}};

std::vector<std::string> names_of_keys() {
  std::vector<std::string> names;
  for (const Key& key : keys) names.emplace_back(key.name);
  return names;
}

Kind kind_of(const Body& body) {
  constexpr Kind kinds[] = {lattice_cylinder, cone, box, foam, lattice, file};  // of the shapes
  if (body.shape == Body::Shape::cylinder && body.method == Body::Method::fitted) return fitted_cylinder;
  return kinds[static_cast<int>(body.shape)];
}

std::string name_of(Kind kind) {
  constexpr const char* names[] = {"lattice cylinder", "fitted cylinder", "cone", "box", "foam", "lattice", "file"};
  return names[std::countr_zero<unsigned>(kind)];
}

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
// with the number of its line, for each line that is not a key with a value. Throws Error of one line if this is
// another kind of file: most of its first lines are no lines of a recipe.
class Lines {
 public:
  Lines(const std::filesystem::path& path, std::vector<std::string>& problems) : path_(path), problems_(problems) {}

  std::vector<Entries> read() {
    if (const std::string why = unreadable(path_); !why.empty()) throw Error(why);
    std::ifstream stream(path_);
    std::string text;
    int lines = 0;
    for (int number = 1; std::getline(stream, text); ++number) {
      if (number == 1) text = without_mark(text);
      const std::string content(trimmed(std::string_view(text).substr(0, text.find('#'))));
      if (content.empty()) continue;
      if (content.find('\0') != std::string::npos)
        throw Error(path_.string() + ": it is no recipe but holds other than text");
      read_line(content, number);
      if (++lines == looked_at || stream.peek() == EOF) check_kind(lines);
    }
    if (bodies_.empty()) return {common_};
    for (Entries& body : bodies_) body.by_key.insert(common_.by_key.begin(), common_.by_key.end());
    return bodies_;
  }

 private:
  static constexpr int looked_at = 100;

  void check_kind(int lines) const {
    if (lines > looked_at || foreign_ <= 2 || foreign_ < lines / 2) return;
    throw Error(path_.string() + ": it is no recipe: expected lines 'key = value' or '[body]', found '" +
                first_foreign_ + "'" +
                " and others; meshes of other programs are for tools/tetrahedra, images for tools/voxels");
  }

  // A line that cannot be of a recipe.
  void take_foreign(const std::string& content) {
    if (foreign_++ > 0) return;
    for (const char c : content.substr(0, 60)) first_foreign_ += c >= ' ' && c <= '~' ? c : '?';
  }

  void read_line(const std::string& content, int number) {
    if (content == "[body]") {
      bodies_.push_back({number});
      return;
    }
    const auto sign = content.find('=');
    if (sign == std::string::npos) {
      take_foreign(content);
      return fail(number, "expected 'key = value' or '[body]', found '" + content + "'");
    }
    const std::string key(trimmed(content.substr(0, sign))), value(trimmed(content.substr(sign + 1)));
    if (std::ranges::find(keys_, key) == keys_.end()) {
      if (key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_ ") != std::string::npos) take_foreign(content);
      return fail(number, "unknown key '" + key + "'" + did_you_mean(key, keys_) + "; keys are " + joined(keys_));
    }
    Entries& body = bodies_.empty() ? common_ : bodies_.back();
    if (value.empty()) return fail(number, "key '" + key + "' has no value");
    if (const Entry* first = body.find(key)) {
      return fail(number, "key '" + key + "' again (first in line " + std::to_string(first->line) + ")");
    }
    body.by_key[key] = {value, number};
  }

  void fail(int line, const std::string& problem) {
    problems_.push_back("line " + std::to_string(line) + ": " + problem);
  }

  const std::filesystem::path& path_;
  const std::vector<std::string> keys_ = names_of_keys();
  std::vector<std::string>& problems_;
  int foreign_ = 0;
  std::string first_foreign_;
  Entries common_{1};
  std::vector<Entries> bodies_;
};

// Converts entries to a Body.
class Converter {
 public:
  // `folder`: of the recipe.
  Converter(const Entries& entries, const std::filesystem::path& folder, std::vector<std::string>& problems)
      : entries_(entries), folder_(folder), problems_(problems) {}

  Body convert() {
    Body body;
    body.shape = choice<Body::Shape>("shape", {"cylinder", "cone", "box", "foam", "lattice", "file"}, 0);
    const int usual = body.shape == Body::Shape::cone ? 1 : 0;
    body.method = choice<Body::Method>("method", {"lattice", "fitted"}, usual);
    const Kind kind = kind_of(body);
    for (const Key& key : keys) {
      const Entry* entry = entries_.find(key.name);
      if (entry != nullptr) {
        check_and_take(key, *entry, kind, body);
      } else if (key.required && (key.kinds & kind) != 0 && !has_other(key, kind)) {
        problems_.push_back("the body that starts in line " + std::to_string(entries_.line) + " lacks the key '" +
                            key.name + "'");
      }
    }
    check(body, kind);
    return body;
  }

 private:
  // True if another key stands in the place of this one.
  bool has_other(const Key& key, Kind kind) const {
    return kind == lattice && key.unless != nullptr && entries_.find(key.unless) != nullptr;
  }

  void check_and_take(const Key& key, const Entry& entry, Kind kind, Body& body) {
    if ((key.kinds & kind) == 0) return fail(entry, "a " + name_of(kind) + " has no key '" + key.name + "'");
    if (key.needs != nullptr && entries_.find(key.needs) == nullptr) {
      return fail(entry, std::string("a body without the key '") + key.needs + "' has no key '" + key.name + "'");
    }
    if (key.expected == nullptr) return take(key.name, entry, kind, body);
    if (take_numbers(key, numbers(entry.value), body)) return;
    fail(entry, std::string(key.name) + " is '" + entry.value + "', expected " + key.expected);
  }

  // Returns false if they are not as many, not whole, or beyond the limits.
  static bool take_numbers(const Key& key, const std::vector<double>& values, Body& body) {
    const auto* const three = std::get_if<Vector Body::*>(&key.numbers);
    const auto* const whole = std::get_if<int Body::*>(&key.numbers);
    const auto is_wrong = [&](double x) { return !(x >= key.low && x <= key.high) || (whole && x != std::floor(x)); };
    if (values.size() != (three ? 3 : 1) || std::ranges::any_of(values, is_wrong)) return false;
    if (three) {
      body.** three = Vector(values.data());
    } else if (whole) {
      body.** whole = static_cast<int>(values[0]);
    } else {
      body.*std::get<double Body::*>(key.numbers) = values[0];
    }
    return true;
  }

  // Keys that are no numbers with limits.
  void take(const std::string& key, const Entry& entry, Kind kind, Body& body) {
    if (key == "name" || (key == "file" && !body.named)) body.name = entry.value;
    if (key == "name") body.named = true;
    if (key == "name" && entry.value.find_first_of(" \t") != std::string::npos) {
      fail(entry, "name is '" + entry.value + "', expected one word: a deck names blocks with blanks between them");
    }
    if (key == "file") body.file = folder_ / entry.value;
    if (key == "elements") body.elements = choice<Body::Elements>(key, {"hex", "sphere"}, 0);
    if (key == "centred") body.centered = choice<Body::Centered>(key, {"point", "corner"}, 1);
    if (key == "origin") body.origin = vector(entry);
    if (key == "seed") body.seed = whole(entry);
    if (key == "method" && kind == cone && body.method == Body::Method::lattice) {
      fail(entry, "a cone has only the method fitted");
    }
    if (key == "method" && (kind & (box | of_struts)) != 0 && body.method == Body::Method::fitted) {
      fail(entry, "a " + name_of(kind) + " has only the method lattice");
    }
    if (key == "section") {
      body.three_cornered = choice<int>(key, {"round", "three-cornered"}, 0) == 1;
    }
    if (key == "periodic") take_axes(entry, body);
    if (key == "lattice") choice<int>(key, lattice_names(), 0), body.lattice = entry.value;
    if (key == "count") take_count(entry, body);
  }

  void take_axes(const Entry& entry, Body& body) {
    for (const std::string& word : to_words(entry.value)) {
      const bool is_axis = word.size() == 1 && word[0] >= 'x' && word[0] <= 'z';
      if (!is_axis) {
        return fail(entry, "periodic is '" + entry.value + "', expected axes: x, y, z, with blanks between");
      }
      body.periodic[word[0] - 'x'] = true;
    }
  }

  // Whole cells along each axis; one number holds for all three.
  void take_count(const Entry& entry, Body& body) {
    const std::string& text = entry.value;
    const bool is_one = text.find_first_of(" \t") == std::string::npos;
    const Vector count = is_one ? Vector(Vector::Constant(number(text))) : vector(entry);
    const bool fits = (count.array() >= 1).all() && (count.array() == count.array().floor()).all();
    if (!fits) return fail(entry, "count is '" + text + "', expected one or three whole numbers of cells");
    body.size = count * body.cell;
  }

  void check_lattice(const Body& body) {
    for (const auto& [one, other] : {std::pair("size", "count"), {"relative_density", "thickness"}}) {
      const Entry* entry = entries_.find(other);
      if (entry && entries_.find(one)) fail(*entry, std::string(other) + " and " + one + " exclude each other");
    }
    const Entry* thickness = entries_.find("thickness");
    if (thickness && body.is_solid()) {
      fail(*thickness, "a solid on one side of a surface has no thickness; expected relative_density");
    }
  }

  void check(const Body& body, Kind kind) {
    if (kind == lattice) check_lattice(body);
    if (const Entry* entry = entries_.find("cells"); entry != nullptr && (kind & gathered) != 0) {
      if (body.elements == Body::Elements::spheres) fail(*entry, "a body of spheres has no key 'cells'");
      if (body.cells > 0 && entries_.find("grading") != nullptr && kind == box) {
        fail(*entries_.find("grading"), "cells that gather voxels are all alike: leave out grading or cells");
      }
    }
    if (body.coarsest > 0 && body.coarsest < body.spacing) {
      fail(*entries_.find("coarsest"), "coarsest is less than the spacing, with which layers begin");
    }
  }

  std::uint64_t whole(const Entry& entry) {
    std::uint64_t value = 0;
    const char* last = entry.value.data() + entry.value.size();
    const auto [end, error] = std::from_chars(entry.value.data(), last, value);
    if (error != std::errc() || end != last)
      fail(entry, "'" + entry.value + "' is not a whole number from 0 to 2⁶⁴ - 1");
    return value;
  }

  void fail(const Entry& entry, const std::string& problem) {
    problems_.push_back("line " + std::to_string(entry.line) + ": " + problem);
  }

  // The Enum whose number is the index of the key's value in `words`; `usual` if the key is missing or its value wrong.
  template <class Enum>
  Enum choice(const std::string& key, const std::vector<std::string>& words, int usual) {
    const Entry* entry = entries_.find(key);
    if (entry == nullptr) return static_cast<Enum>(usual);
    const auto found = std::find(words.begin(), words.end(), entry->value);
    if (found != words.end()) return static_cast<Enum>(found - words.begin());
    fail(*entry,
         key + " is '" + entry->value + "', expected " + joined(words, " or ") + did_you_mean(entry->value, words));
    return static_cast<Enum>(usual);
  }

  // Returns NaN if the word is no finite number.
  static double number(const std::string& word) { return to_finite(word).value_or(NAN); }

  static std::vector<double> numbers(const std::string& text) {
    std::vector<double> values;
    for (const std::string& word : to_words(text)) values.push_back(number(word));
    return values;
  }

  Vector vector(const Entry& entry) {
    const std::vector<double> values = numbers(entry.value);
    const bool fits = values.size() == 3 && std::isfinite(values[0] + values[1] + values[2]);
    if (fits) return {values[0], values[1], values[2]};
    fail(entry, "'" + entry.value + "' is not three numbers");
    return Vector::Ones();
  }

  const Entries& entries_;
  const std::filesystem::path& folder_;
  std::vector<std::string>& problems_;
};

}  // namespace

std::vector<Body> read_recipe(const std::filesystem::path& path) {
  std::vector<std::string> problems;
  std::vector<Body> bodies;
  std::set<std::string> names;
  for (const Entries& entries : Lines(path, problems).read()) {
    bodies.push_back(Converter(entries, path.parent_path(), problems).convert());
    if (!names.insert(bodies.back().name).second)
      problems.push_back("two bodies are called '" + bodies.back().name + "'");
  }
  constexpr std::size_t most_reported = 30;
  if (problems.size() > most_reported) {
    problems[most_reported] = "and " + std::to_string(problems.size() - most_reported) + " others";
    problems.resize(most_reported + 1);
  }
  if (!problems.empty()) throw Error(path.string() + ":\n  " + joined(problems, "\n  "));
  return bodies;
}

}  // namespace strut::mesh
