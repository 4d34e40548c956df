#include "deck/schema.hpp"

#include <cmath>

#include "base/errors.hpp"
#include "base/numbers.hpp"

namespace strut::deck {

namespace {

std::string describe(Kind kind) {
  switch (kind) {
    case Kind::real:
      return "a real number";
    case Kind::integer:
      return "an integer";
    case Kind::boolean:
      return "true or false (type bool)";
    case Kind::reals:
      return "a list of real numbers";
    case Kind::vector:
      return "three real numbers";
    case Kind::text:
      return "a text (type string)";
    case Kind::choice:
      return "one of ";
    case Kind::axes:
      return "one or several of x, y, z, such as xy";
    case Kind::names:
      return "names separated by blanks (type string)";
    case Kind::expression:
      return "a number or an expression in x, y, z, t";
  }
  return "";
}

}  // namespace

bool Range::contains(double value) const {
  return (with_low ? value >= low : value > low) && (with_high ? value <= high : value < high);
}

std::string Range::text() const {
  const bool bounded_below = std::isfinite(low), bounded_above = std::isfinite(high);
  if (bounded_below && bounded_above) {
    return "in " + std::string(with_low ? "[" : "(") + to_text(low) + ", " + to_text(high) + (with_high ? "]" : ")");
  }
  if (bounded_below) return (with_low ? "≥ " : "> ") + to_text(low);
  if (bounded_above) return (with_high ? "≤ " : "< ") + to_text(high);
  return "";
}

Section with_cases(Section section, Key selector, std::vector<Section> cases) {
  for (const Section& one : cases) selector.choices.push_back(one.name);
  selector.kind = Kind::choice;
  selector.required = !selector.fallback;
  section.selector = selector.name;
  section.keys.insert(section.keys.begin(), std::move(selector));
  section.cases = std::move(cases);
  return section;
}

std::string expected(const Key& key) {
  std::string text = "expected " + describe(key.kind) + joined(key.choices);
  if (const std::string range = key.range.text(); !range.empty()) text += " " + range;
  if (!key.unit.empty()) text += ", in " + key.unit;
  return text;
}

}  // namespace strut::deck
