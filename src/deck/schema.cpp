#include "deck/schema.hpp"

#include <cmath>

#include "base/errors.hpp"
#include "base/numbers.hpp"

namespace strut::deck {

const KindFacts& facts_of(Kind kind) {
  static constexpr KindFacts all[] = {// in the order of Kind
                                      {"real", "a real number", Numbers::real},
                                      {"integer", "an integer", Numbers::integer},
                                      {"bool", "true or false (type bool)", Numbers::none},
                                      {"reals", "a list of real numbers", Numbers::several},
                                      {"3 reals", "three real numbers", Numbers::several},
                                      {"text", "a text (type string)", Numbers::none},
                                      {"choice", "one of ", Numbers::none},
                                      {"axes", "one or several of x, y, z, such as xy", Numbers::none},
                                      {"names", "names separated by blanks (type string)", Numbers::none},
                                      {"expression", "a number or an expression in x, y, z, t", Numbers::real}};
  return all[static_cast<int>(kind)];
}

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
  std::string text = std::string("expected ") + facts_of(key.kind).expected + joined(key.choices);
  if (const std::string range = key.range.text(); !range.empty()) text += " " + range;
  if (!key.unit.empty()) text += ", in " + key.unit;
  return text;
}

}  // namespace strut::deck
