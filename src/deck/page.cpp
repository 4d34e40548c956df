// The reference page of all keys, from the schema.
#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "base/math/function.hpp"
#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "deck/schema.hpp"

namespace strut::deck {

namespace {

std::string range_text(const Key& key) {
  std::string text = key.range.text();
  for (const std::string& choice : key.choices) text += (text.empty() ? "`" : ", `") + choice + "`";
  return text;
}

std::string default_text(const Key& key) {
  if (key.required) return "required";
  return key.fallback ? "default `" + *key.fallback + "`" : "";
}

// "reals > 0, m"; "> 0, m" of a real number; of a choice its choices.
std::string value_text(const Key& key) {
  const std::string range = range_text(key);
  const bool is_shown = key.kind != Kind::choice && (key.kind != Kind::real || (range.empty() && key.unit.empty()));
  std::string text = is_shown ? facts_of(key.kind).name : "";
  if (!range.empty()) text += (text.empty() ? "" : " ") + range;
  return key.unit.empty() ? text : text + (text.empty() ? "" : ", ") + key.unit;
}

std::string quoted(const std::string& name) { return name == any_name ? name : "`" + name + "`"; }

bool alike(const Key& one, const Key& other) {
  return value_text(one) == value_text(other) && default_text(one) == default_text(other) &&
         one.meaning == other.meaning;
}

// A name or meaning with each single X replaced by the axis: "Travel X", "Normal_X", "along X as".
std::string along(const std::string& text, char axis) {
  std::string other = text;
  const auto letter = [&text](std::size_t i) {
    return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i]));
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == 'X' && !(i > 0 && letter(i - 1)) && !letter(i + 1)) other[i] = axis;
  }
  return other;
}

using Keys = std::vector<Key>;

const Key* find(const Keys& keys, const std::string& name) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&name](const Key& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

// The names of the keys that are the same along x, y and z, of which `key` is the first; of others its own name.
std::vector<std::string> names_along_axes(const Key& key, const Keys& keys) {
  std::vector<std::string> names = {key.name};
  for (const char axis : {'Y', 'Z'}) {
    const std::string name = along(key.name, axis);
    const Key* other = name == key.name ? nullptr : find(keys, name);
    Key expected = key;
    expected.meaning = along(key.meaning, axis);
    if (other && alike(*other, expected)) names.push_back(name);
  }
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (name == names.front() ? "" : ", ") + quoted(name);
  return text;
}

// "- `Horizon` (real > 0, m; required): …", indented.
std::string row(const Key& key, const std::vector<std::string>& names, const std::string& indent) {
  const std::string value = value_text(key), fallback = default_text(key);
  const std::string both = value + (value.empty() || fallback.empty() ? "" : "; ") + fallback;
  return indent + "- " + listed(names) + (both.empty() ? "" : " (" + both + ")") +
         (key.meaning.empty() ? "" : ": " + key.meaning) + "\n";
}

std::string rows(const Keys& keys, const std::string& indent = "") {
  std::string text;
  std::set<std::string> done;
  std::vector<std::string> ineffective;
  for (const Key& key : keys) {
    if (done.count(key.name)) continue;
    const std::vector<std::string> names = names_along_axes(key, keys);
    done.insert(names.begin(), names.end());
    if (key.no_effect.empty())
      text += row(key, names, indent);
    else
      ineffective.push_back(key.name);
  }
  if (!ineffective.empty()) text += indent + "- Peridigm's, without effect: " + listed(ineffective) + ".\n";
  return text;
}

// Keys that several cases have in common; they have a list of their own if they are this many.
constexpr std::size_t least_shared = 4;
struct SharedKeys {
  std::vector<std::string> cases;
  Keys keys;
};

std::vector<SharedKeys> shared_keys(const std::vector<Section>& cases) {
  std::vector<SharedKeys> groups;
  for (const Section& one : cases) {
    for (const Key& key : one.keys) {
      std::vector<std::string> owners;
      for (const Section& other : cases) {
        const Key* same = find(other.keys, key.name);
        if (same && alike(*same, key)) owners.push_back(other.name);
      }
      if (owners.size() < 2 || owners.front() != one.name) continue;
      const auto group =
          std::find_if(groups.begin(), groups.end(), [&owners](const SharedKeys& g) { return g.cases == owners; });
      (group == groups.end() ? groups.emplace_back(SharedKeys{owners, {}}) : *group).keys.push_back(key);
    }
  }
  std::erase_if(groups, [](const SharedKeys& group) { return group.keys.size() < least_shared; });
  return groups;
}

Keys own_keys(const Section& one, const std::vector<SharedKeys>& shared) {
  Keys keys;
  for (const Key& key : one.keys) {
    const bool stands_below = std::any_of(shared.begin(), shared.end(), [&](const SharedKeys& group) {
      const Key* same = find(group.keys, key.name);
      return same && alike(*same, key);
    });
    if (!stands_below) keys.push_back(key);
  }
  return keys;
}

// The page so far, and the path of the section that is written.
struct Written {
  std::map<std::string, std::string> bodies, keys;  // of sections; name and meaning of keys

  // Leaves out a long meaning that a key of this name has further up in the section, or names the section that has it.
  void shorten(Key& key, const std::string& path) {
    if (key.meaning.size() <= 20) return;
    const auto [same, is_new] = keys.emplace(key.name + "\n" + key.meaning, path);
    if (is_new) return;
    if (same->second == path)
      key.meaning.clear();
    else if (key.meaning.size() > 60)
      key.meaning = "As in " + same->second + ".";
  }
};

std::string section_text(const Section& section, const std::string& path, Written& written);

bool nested(const Section& section) {
  return std::any_of(section.cases.begin(), section.cases.end(),
                     [](const Section& one) { return !one.sections.empty(); });
}

std::string cases_text(const Section& section, const std::string& path, Written& written) {
  const std::vector<SharedKeys> shared = shared_keys(section.cases);
  const bool headed = nested(section);
  const auto heading = [&](const std::string& names) {
    const std::string equation = section.selector + " = " + names;
    return headed ? "\n### " + equation + "\n\n" : "- " + equation + ": ";
  };
  const std::string indent = headed ? "" : "  ";
  std::string text;
  for (const Section& one : section.cases) {
    Keys own = own_keys(one, shared);
    for (Key& key : own) written.shorten(key, path);
    const std::string keys = rows(own, indent);
    text += heading("\"" + one.name + "\"") + one.meaning + "\n" + (headed && !keys.empty() ? "\n" : "") + keys;
    for (const Section& inner : one.sections) text += section_text(inner, path_to(path, inner.name), written);
  }
  for (const SharedKeys& group : shared) {
    std::string names;
    for (const std::string& name : group.cases) names += (names.empty() ? "\"" : ", \"") + name + "\"";
    text += heading(names) + (headed ? "" : "\n") + rows(group.keys, indent);
  }
  return text;
}

// Meaning, keys and cases.
std::string body_text(const Section& section, const std::string& path, Written& written) {
  Keys keys = section.keys;
  if (section.any_key) keys.push_back(*section.any_key);
  for (Key& key : keys)  // the cases stand below
    if (key.name == section.selector && !section.cases.empty() && !nested(section)) key.choices.clear();
  for (Key& key : keys) written.shorten(key, path);
  const std::string list = rows(keys);
  return (section.meaning.empty() ? "" : section.meaning + "\n") + (list.empty() ? "" : "\n" + list) +
         cases_text(section, path, written);
}

// Only sections of any name: these need no heading of their own.
bool holds_names_only(const Section& section) {
  return section.keys.empty() && !section.any_key && section.cases.empty() && section.sections.size() == 1 &&
         section.sections.front().name == any_name;
}

// Meaning, keys and cases of a section and of those of any name in it.
std::string whole_body(const Section& section, const std::string& path, Written& written) {
  const std::string body = body_text(section, path, written);
  if (!holds_names_only(section)) return body;
  const Section& named = section.sections.front();
  return body + "\nIn sections of any name: " + body_text(named, path_to(path, any_name), written);
}

std::string section_text(const Section& section, const std::string& path, Written& written) {
  std::string text = path.empty() ? "" : "\n## " + path + (section.required ? " (required)" : "") + "\n\n";
  Written none;
  const auto [same, is_new] = written.bodies.emplace(whole_body(section, path, none), path);
  text += is_new ? whole_body(section, path, written) : "The keys of " + same->second + ".\n";
  const bool is_named = holds_names_only(section);
  const Section& owner = is_named ? section.sections.front() : section;
  const std::string owner_path = is_named ? path_to(path, any_name) : path;
  for (const Section& inner : owner.sections) text += section_text(inner, path_to(owner_path, inner.name), written);
  return text;
}

const char* const introduction = R"(# Keys of a deck

Generated from the schema in `src/deck`; do not edit by hand. SI units throughout.

A deck is an XML file of nested sections, `<ParameterList name="…">`, and keys, `<Parameter name="…" type="…" value="…"/>`, or the same in YAML. `Blocks > (any name) > Horizon` is the key `Horizon` in a section of any name in the section `Blocks`. In brackets: the value (a real number unless stated), its unit, and `required` or the default. A key without meaning has that of its namesake above.

- bool: type `bool`, `true` or `false`.
- integer: type `int`, or `string` with an integer.
- real number: type `double` or `int`, or `string` with a number; finite.
- reals: type `string` (`0 0.1 0.5`) or `Array(double)` (`{0, 0.1, 0.5}`).
- text, names (separated by blanks), and choices such as `A`, `B`, letter by letter: type `string`.
- axes: type `string`, e.g. `z`, `xy`, `xyz`.
- expression: a number, or type `string`: C-like, in x, y, z, t, e.g. `-50`, `1e-3*t`, `sin(x)`.
)";

std::string expressions() {
  return "\nAn expression has the operators `+ - * /`, `^` (power), comparisons and `&& || !` (1 or 0), and the "
         "functions " +
         joined(functions_in_expressions()) +
         ". `pow`, `atan2`, `min` and `max` take two arguments, `gamma` is Γ, `j0 j1 i0 i1` are Bessel's. `t &lt; 1e-4 "
         "? 5 "
         ": 0` is 5 before t = 1e-4, 0 from then on. `table(t, 0, 0, 1e-3, 5)` is 0 at t = 0 and 5 at 1e-3, linear "
         "between and constant beyond; `table(t, 'pull.csv')` has these numbers from a file beside the deck, a row of "
         "time and value for each (comma, semicolon or blanks between, comments after #, one header), in the units of "
         "the deck. Statements may assign to `value`: `value = 0; if (t &lt; 1e-4) { value = 5*sin(x); }`, with "
         "`if`, `else` and variables (`double r = x*x;`), without loops. A sign and a power need brackets, `-(x^2)` or "
         "`(-x)^2`. In XML `<` is written `&lt;` and `&` `&amp;`.\n";
}

bool same_word(const std::string& one, const std::string& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

std::string explained(const Key& key, const std::string& path) {
  std::string text = path_to(path, key.name) + "\n  " + (key.required ? "required; " : "") + expected(key);
  if (key.fallback) text += "; default '" + *key.fallback + "'";
  return text + "\n  " + (key.meaning.empty() ? key.no_effect : key.meaning) + "\n";
}

// Adds the description of the name in this section and those within it; collects all names.
void explain(const Section& section, const std::string& path, const std::string& name, std::string& text,
             std::vector<std::string>& names) {
  for (const Key& key : section.keys) {
    names.push_back(key.name);
    if (same_word(key.name, name)) text += explained(key, path);
  }
  for (const Section& one : section.cases) explain(one, path + " (" + one.name + ")", name, text, names);
  for (const Section& inner : section.sections) {
    const std::string inner_path = path_to(path, inner.name);
    names.push_back(inner.name);
    if (same_word(inner.name, name))
      text += inner_path + (inner.required ? " (required)" : "") + "\n  " + inner.meaning + "\n";
    explain(inner, inner_path, name, text, names);
  }
}

}  // namespace

std::string explanation(const std::string& name) {
  std::string text;
  std::vector<std::string> names;
  explain(schema(), "", name, text, names);
  if (text.empty()) throw Error("a deck has no key or section '" + name + "'" + did_you_mean(name, names));
  return text;
}

std::string reference_page() {
  Written written;
  return introduction + expressions() + "\n## The whole deck\n" + section_text(schema(), "", written);
}

}  // namespace strut::deck
