#include "mesh/recipe.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "mesh/lattices.hpp"

namespace strut::mesh {

namespace {

const std::vector<std::string> keys = {
    "name",         "shape", "method",        "centred", "elements",       "length",
    "radius",       "size",  "spacing",       "origin",  "cell",           "relative_density",
    "irregularity", "seed",  "file",          "grading", "uniform",        "coarsest",
    "top_radius",   "cells", "smallest_cell", "lattice", "count",          "thickness",
    "periodic",     "sizes", "relax",         "stretch", "node_thickness", "section"};

const std::vector<std::string> only_foam_keys = {"irregularity", "seed", "sizes", "relax", "stretch", "section"};
const std::vector<std::string> only_lattice_keys = {"lattice", "count", "thickness"};
const std::vector<std::string> foam_keys = [] {
  std::vector<std::string> keys = {"cell", "relative_density", "periodic", "node_thickness"};
  for (const auto& more : {only_foam_keys, only_lattice_keys}) keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}();
const std::vector<std::string> gathering_keys = {"cells", "smallest_cell"};
const std::vector<std::string> grading_keys = {"grading", "uniform", "coarsest"};

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

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

// Parses lines into entries; checks only whether a line is a known key with a value.
class Lines {
 public:
  explicit Lines(std::vector<std::string>& problems) : problems_(problems) {}

  // Throws Error of one line if this is another kind of file: most of its first lines are no lines of a recipe.
  std::vector<Entries> read(std::istream& stream) {
    std::string text;
    int lines = 0;
    for (int number = 1; std::getline(stream, text); ++number) {
      const std::string content = trimmed(text.substr(0, text.find('#')));
      if (content.empty()) continue;
      if (content.find('\0') != std::string::npos) throw Error("it is no recipe but holds other than text");
      read_line(content, number);
      if (++lines == looked_at || stream.peek() == EOF) check_kind(lines);
    }
    if (bodies_.empty()) return {common_};
    for (Entries& body : bodies_) body.take_defaults(common_);
    return bodies_;
  }

 private:
  static constexpr int looked_at = 100;

  void check_kind(int lines) const {
    if (lines > looked_at || foreign_ <= 2 || foreign_ < lines / 2) return;
    throw Error("it is no recipe: expected lines 'key = value' or '[body]', found '" + first_foreign_ + "'" +
                " and others; meshes of other programs are for tools/tetrahedra, images for tools/voxels");
  }

  // A line that cannot be of a recipe.
  void take_foreign(const std::string& content) {
    if (foreign_++ > 0) return;
    for (const char c : content.substr(0, 60)) first_foreign_ += c >= ' ' && c <= '~' ? c : '?';
  }

  void read_line(const std::string& content, int number) {
    if (content == "[body]") {
      bodies_.emplace_back(number);
      return;
    }
    const auto sign = content.find('=');
    if (sign == std::string::npos) {
      take_foreign(content);
      return fail(number, "expected 'key = value' or '[body]', found '" + content + "'");
    }
    const std::string key = trimmed(content.substr(0, sign));
    const std::string value = trimmed(content.substr(sign + 1));
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      if (key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_ ") != std::string::npos) take_foreign(content);
      return fail(number, "unknown key '" + key + "'" + did_you_mean(key, keys) + "; keys are " + joined(keys));
    }
    Entries& body = bodies_.empty() ? common_ : bodies_.back();
    if (value.empty()) return fail(number, "key '" + key + "' has no value");
    if (const Entry* first = body.find(key)) {
      return fail(number, "key '" + key + "' again (first in line " + std::to_string(first->line) + ")");
    }
    body.set(key, {value, number});
  }

  void fail(int line, const std::string& problem) {
    problems_.push_back("line " + std::to_string(line) + ": " + problem);
  }

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
    body.shape = choice<Body::Shape>("shape", {"cylinder", "cone", "box", "foam", "lattice", "file"}, std::nullopt);
    if (const Entry* entry = entries_.find("origin")) body.origin = vector(*entry);
    if (body.shape == Body::Shape::file) {
      convert_file(body);
    } else {
      convert_made(body);
    }
    if (const Entry* entry = entries_.find("name")) {
      body.name = entry->value;
      body.named = true;
    }
    return body;
  }

 private:
  void convert_file(Body& body) {
    refuse({"method", "elements", "spacing", "length", "radius", "top_radius", "centred", "size"}, "file");
    refuse(foam_keys, "file");
    refuse(grading_keys, "file");
    refuse(gathering_keys, "file");
    const Entry* entry = required("file");
    if (entry == nullptr) return;
    body.file = folder_ / entry->value;
    body.name = entry->value;
  }

  void convert_made(Body& body) {
    const bool cone = body.shape == Body::Shape::cone;
    body.method = choice<Body::Method>("method", {"lattice", "fitted"}, cone ? "fitted" : "lattice");
    body.elements = choice<Body::Elements>("elements", {"hex", "sphere"}, "hex");
    body.spacing = length("spacing");
    convert_gathering(body);
    if (cone) return convert_cone(body);
    if (body.shape == Body::Shape::cylinder) return convert_cylinder(body);
    if (body.shape == Body::Shape::lattice) return convert_lattice(body);
    convert_box(body, body.shape == Body::Shape::foam ? "foam" : "box");
    if (body.shape == Body::Shape::foam) convert_foam(body);
  }

  void convert_cylinder(Body& body) {
    body.length = length("length");
    body.radius = length("radius");
    body.centered = choice<Body::Centered>("centred", {"point", "corner"}, "corner");
    refuse({"size", "file", "top_radius"}, "cylinder");
    refuse(foam_keys, "cylinder");
    if (body.method == Body::Method::fitted) {
      refuse({"centred"}, "fitted cylinder");
      convert_grading(body);
    } else {
      refuse(grading_keys, "lattice cylinder");  // its cells are cubes
    }
  }

  void convert_cone(Body& body) {
    body.length = length("length");
    body.radius = length("radius");
    body.top_radius = length("top_radius");
    refuse({"size", "file", "centred"}, "cone");
    refuse(foam_keys, "cone");
    if (body.method == Body::Method::lattice) fail(*entries_.find("method"), "a cone has only the method fitted");
    convert_grading(body);
  }

  void convert_box(Body& body, const std::string& shape) {
    refuse({"length", "radius", "top_radius", "centred", "file"}, shape);
    if (shape == "box") {
      refuse(foam_keys, shape);
      convert_grading(body);
    } else {
      refuse(grading_keys, shape);
    }
    if (body.method == Body::Method::fitted)
      fail(*entries_.find("method"), "a " + shape + " has only the method lattice");
    if (shape == "lattice" && entries_.find("count")) return;
    const Entry* entry = required("size");
    if (entry == nullptr) return;
    body.size = vector(*entry);
    if (!(body.size.minCoeff() > 0)) fail(*entry, "size is '" + entry->value + "', expected three lengths > 0");
  }

  void convert_foam(Body& body) {
    refuse(only_lattice_keys, "foam");
    body.cell = length("cell");
    if (required("relative_density")) convert_density(body);
    if (entries_.find("irregularity")) body.irregularity = between("irregularity", 0, 1);
    if (const Entry* entry = entries_.find("seed")) body.seed = whole(*entry);
    if (entries_.find("sizes")) body.sizes = between("sizes", 0, 0.6);
    if (const Entry* entry = entries_.find("relax")) {
      body.relax = static_cast<int>(between("relax", 0, 1000));
      if (entry->value.find_first_not_of("0123456789") != std::string::npos) fail(*entry, "relax is no whole number");
    }
    if (const Entry* entry = entries_.find("stretch")) {
      body.stretch = vector(*entry);
      if (!(body.stretch.minCoeff() >= 0.2 && body.stretch.maxCoeff() <= 5)) {
        fail(*entry, "stretch is '" + entry->value + "', expected three numbers from 0.2 to 5");
      }
    }
    enum class Section { round, three_cornered };
    body.three_cornered = choice<Section>("section", {"round", "three-cornered"}, "round") == Section::three_cornered;
    convert_members(body);
  }

  void convert_lattice(Body& body) {
    convert_box(body, "lattice");
    refuse(only_foam_keys, "lattice");
    body.cell = length("cell");
    const std::vector<std::string>& names = lattice_names();
    const Entry* name = required("lattice");
    if (name) body.lattice = name->value;
    if (name && std::find(names.begin(), names.end(), name->value) == names.end()) {
      fail(*name,
           "lattice is '" + name->value + "', expected " + joined(names, " or ") + did_you_mean(name->value, names));
    }
    if (const Entry* entry = entries_.find("count")) convert_count(*entry, body);
    const Entry *density = entries_.find("relative_density"), *thickness = entries_.find("thickness");
    if (density && thickness) fail(*thickness, "thickness and relative_density exclude each other");
    if (thickness) {
      body.thickness = length("thickness");
      if (body.lattice == "gyroid" || body.lattice == "diamond") {
        fail(*thickness, "a solid on one side of a surface has no thickness; expected relative_density");
      }
    } else if (required("relative_density")) {
      convert_density(body);
    }
    convert_members(body);
  }

  // Whole cells along each axis; one number holds for all three.
  void convert_count(const Entry& entry, Body& body) {
    if (const Entry* size = entries_.find("size")) fail(*size, "count and size exclude each other");
    const std::string& text = entry.value;
    const bool is_one = text.find_first_of(" \t") == std::string::npos;
    const Vector count = is_one ? Vector(Vector::Constant(number(text).value_or(NAN))) : vector(entry);
    const bool fits = (count.array() >= 1).all() && (count.array() == count.array().floor()).all();
    if (!fits) return fail(entry, "count is '" + text + "', expected one or three whole numbers of cells");
    body.size = count * body.cell;
  }

  void convert_members(Body& body) {
    if (const Entry* entry = entries_.find("periodic")) convert_axes(*entry, body);
    if (entries_.find("node_thickness")) body.node_thickness = between("node_thickness", 1, 4);
  }

  void convert_axes(const Entry& entry, Body& body) {
    std::istringstream stream(entry.value);
    for (std::string word; stream >> word;) {
      const bool is_axis = word.size() == 1 && word[0] >= 'x' && word[0] <= 'z';
      if (!is_axis)
        return fail(entry, "periodic is '" + entry.value + "', expected axes: x, y, z, with blanks between");
      body.periodic[word[0] - 'x'] = true;
    }
  }

  void convert_density(Body& body) {
    const Entry& entry = *entries_.find("relative_density");
    body.relative_density = number(entry.value).value_or(NAN);
    if (body.relative_density > 0 && body.relative_density < 1) return;
    fail(entry, "relative_density is '" + entry.value + "', expected a number between 0 and 1");
  }

  // The number of a key that is there.
  double between(const std::string& key, double low, double high) {
    const Entry& entry = *entries_.find(key);
    const double value = number(entry.value).value_or(NAN);
    if (value >= low && value <= high) return value;
    std::ostringstream text;
    text << key << " is '" << entry.value << "', expected a number from " << low << " to " << high;
    fail(entry, text.str());
    return low == 0 ? 0.5 * high : low;  // a valid one
  }

  // For cubes only: call it after the method and the elements.
  void convert_gathering(Body& body) {
    const Entry* cells = entries_.find("cells");
    if (cells == nullptr) return refuse({"smallest_cell"}, "body without the key 'cells'");
    if (body.shape == Body::Shape::cone) return refuse(gathering_keys, "cone");
    if (body.method == Body::Method::fitted) return refuse(gathering_keys, "fitted body");
    if (body.elements == Body::Elements::spheres) return refuse(gathering_keys, "body of spheres");
    const double value = number(cells->value).value_or(NAN);
    if (!(value >= 2 && value <= 16 && value == std::floor(value))) {
      return fail(*cells, "cells is '" + cells->value + "', expected a whole number from 2 to 16");
    }
    body.cells = static_cast<int>(value);
    const Entry* smallest = entries_.find("smallest_cell");
    if (smallest == nullptr) return;
    body.smallest_cell = number(smallest->value).value_or(NAN);
    if (!(body.smallest_cell >= 0 && body.smallest_cell <= 0.9)) {
      fail(*smallest, "smallest_cell is '" + smallest->value + "', expected a number from 0 to 0.9");
    }
  }

  void convert_grading(Body& body) {
    const Entry* grading = entries_.find("grading");
    if (grading == nullptr) return refuse({"uniform", "coarsest"}, "body without grading");
    if (body.cells > 0) return fail(*grading, "cells that gather voxels are all alike: leave out grading or cells");
    body.grading = number(grading->value).value_or(NAN);
    if (!(body.grading >= 1 && body.grading <= 2)) {
      fail(*grading, "grading is '" + grading->value + "', expected a number from 1 to 2");
    }
    if (entries_.find("uniform")) body.uniform = length("uniform");
    if (const Entry* entry = entries_.find("coarsest")) {
      body.coarsest = length("coarsest");
      if (body.coarsest < body.spacing) fail(*entry, "coarsest is less than the spacing, with which layers begin");
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

  void refuse(const std::vector<std::string>& keys, const std::string& shape) {
    for (const std::string& key : keys) {
      if (const Entry* entry = entries_.find(key)) fail(*entry, "a " + shape + " has no key '" + key + "'");
    }
  }

  const Entry* required(const std::string& key) {
    const Entry* entry = entries_.find(key);
    if (entry == nullptr) {
      problems_.push_back("the body that starts in line " + std::to_string(entries_.line()) + " lacks the key '" + key +
                          "'");
    }
    return entry;
  }

  template <class Enum>
  Enum choice(const std::string& key, const std::vector<std::string>& words, std::optional<std::string> otherwise) {
    const Entry* entry = otherwise ? entries_.find(key) : required(key);
    if (entry == nullptr && !otherwise) return Enum{};
    const std::string word = entry ? entry->value : *otherwise;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == word) return static_cast<Enum>(i);
    }
    fail(*entry, key + " is '" + word + "', expected " + joined(words, " or ") + did_you_mean(word, words));
    return Enum{};
  }

  static std::optional<double> number(const std::string& word) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
    return value;
  }

  double length(const std::string& key) {
    const Entry* entry = required(key);
    if (entry == nullptr) return 1;
    const std::optional<double> value = number(entry->value);
    if (!value || *value <= 0) fail(*entry, key + " is '" + entry->value + "', expected a length > 0 in m");
    return value.value_or(1);
  }

  Vector vector(const Entry& entry) {
    std::istringstream stream(entry.value);
    std::vector<double> values;
    for (std::string word; stream >> word;) values.push_back(number(word).value_or(NAN));
    const bool fits = values.size() == 3 && std::isfinite(values[0] + values[1] + values[2]);
    if (fits) return {values[0], values[1], values[2]};
    fail(entry, "'" + entry.value + "' is not three numbers");
    return Vector::Ones();
  }

  const Entries& entries_;
  const std::filesystem::path& folder_;
  std::vector<std::string>& problems_;
};

std::vector<Entries> lines_of(const std::filesystem::path& path, std::istream& file,
                              std::vector<std::string>& problems) {
  try {
    return Lines(problems).read(file);
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
}

}  // namespace

std::vector<Body> read_recipe(const std::filesystem::path& path) {
  if (const std::string why = unreadable(path); !why.empty()) throw Error(why);
  std::ifstream file(path);
  std::vector<std::string> problems;
  std::vector<Body> bodies;
  std::set<std::string> names;
  for (const Entries& entries : lines_of(path, file, problems)) {
    bodies.push_back(Converter(entries, path.parent_path(), problems).convert());
    if (!names.insert(bodies.back().name).second)
      problems.push_back("two bodies are called '" + bodies.back().name + "'");
  }
  constexpr std::size_t most_told = 30;
  if (problems.size() > most_told) {
    problems[most_told] = "and " + std::to_string(problems.size() - most_told) + " others";
    problems.resize(most_told + 1);
  }
  if (!problems.empty()) throw Error(path.string() + ":\n  " + joined(problems, "\n  "));
  return bodies;
}

}  // namespace strut::mesh
