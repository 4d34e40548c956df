// The reference page of all keys, from the schema.
#include <algorithm>
#include <cctype>

#include "base/errors.hpp"
#include "base/math/function.hpp"
#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/whole.hpp"

namespace strut::deck {

namespace {

std::string or_dash(const std::string& text) { return text.empty() ? "—" : text; }

std::string escaped(std::string text) {
  for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) text.insert(i, 1, '\\');
  return text;
}

std::string type_text(const Key& key) {
  switch (key.kind) {
    case Kind::boolean:
      return "bool";
    case Kind::integer:
      return "integer";
    case Kind::real:
      return "real";
    case Kind::reals:
      return "reals";
    case Kind::vector:
      return "3 reals";
    case Kind::text:
      return "text";
    case Kind::choice:
      return "choice";
    case Kind::axes:
      return "axes";
    case Kind::names:
      return "names";
    case Kind::expression:
      return "expression";
  }
  return "";
}

std::string range_text(const Key& key) {
  std::string text = key.range.text();
  for (const std::string& choice : key.choices) text += (text.empty() ? "`" : ", `") + choice + "`";
  return text;
}

std::string default_text(const Key& key) {
  if (key.required) return "required";
  return key.fallback ? "`" + *key.fallback + "`" : "—";
}

std::string row(const Key& key) {
  const std::string name = key.name == any_name ? key.name : "`" + key.name + "`";
  return "| " + name + " | " + type_text(key) + " | " + or_dash(key.unit) + " | " + or_dash(range_text(key)) + " | " +
         default_text(key) + " | " + escaped(key.meaning) + " |\n";
}

std::string table(const Section& section) {
  if (section.keys.empty() && !section.any_key) return "";
  std::string text = "\n| key | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const Key& key : section.keys) text += row(key);
  if (section.any_key) text += row(*section.any_key);
  return text;
}

std::string section_text(const Section& section, const std::string& path) {
  std::string text;
  if (!path.empty()) text += "\n## " + path + (section.required ? " (required)" : "") + "\n";
  if (!section.meaning.empty()) text += "\n" + section.meaning + "\n";
  text += table(section);
  for (const Section& one : section.cases) {
    text += "\n### " + path + ", " + section.selector + " = \"" + one.name + "\"\n\n" + one.meaning + "\n" + table(one);
    for (const Section& inner : one.sections) text += section_text(inner, path_to(path, inner.name));
  }
  for (const Section& inner : section.sections) text += section_text(inner, path_to(path, inner.name));
  return text;
}

const char* const introduction = R"(# Keys of a deck

Generated from the schema in `src/deck`; do not edit by hand. SI units throughout.

A deck is an XML file of nested `<ParameterList name="…">`, the sections, and
`<Parameter name="…" type="…" value="…"/>`, the keys. `Blocks > (any name) > Horizon` below is the key `Horizon` in a
section, named as you like, in the section `Blocks`. Unknown keys and sections are errors, and so are values outside
their range; all problems of a deck are reported at once.

| type | written in the deck as |
|---|---|
| bool | type `bool`: `true` or `false` |
| integer | type `int`, or `string` with an integer |
| real | type `double` or `int`, or `string` with a number; finite |
| reals | type `string` (`0 0.1 0.5`) or `Array(double)` (`{0, 0.1, 0.5}`) |
| 3 reals | the same, three of them |
| text | type `string` |
| choice | type `string`: one of the choices in the column range, letter by letter |
| axes | type `string`: one or several of `x`, `y`, `z`, e.g. `z`, `xy`, `xyz` |
| names | type `string`, separated by blanks |
| expression | a number, or type `string`: C-like, in x, y, z, t, e.g. `-50`, `1e-3*t`, `sin(x)` |
)";

std::string expressions() {
  return "\nAn expression has the operators `+ - * /`, `^` (power), comparisons and `&& || !`, which give 1 or 0, and "
         "the\n"
         "functions " +
         joined(functions_in_expressions()) +
         ".\n`pow` and `atan2` take two arguments, `gamma` is Γ, `j0 j1 i0 i1` are Bessel's. There is no `abs` (it is "
         "`fabs`),\n"
         "`min`, `max` or `?:`. `table(t, 0, 0, 1e-3, 5)` has values at rising places, 0 at 0 and 5 at 1e-3, linear "
         "between "
         "them and constant beyond. Instead of an expression there may be statements that assign to `value`:\n"
         "`value = 0; if (t &lt; 1e-4) { value = 5*sin(x); }`. They know `if`, `else`, and variables of their own "
         "(`double r = "
         "x*x;`), but no loops.\nA sign and a power need brackets, `-(x^2)` or `(-x)^2`. At most 10,000 characters. In "
         "XML "
         "`<` is written `&lt;` and `&` `&amp;`.\n";
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
  return introduction + expressions() + "\n## The whole deck\n" + section_text(schema(), "");
}

}  // namespace strut::deck
