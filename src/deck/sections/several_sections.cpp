#include "deck/sections/several_sections.hpp"

#include <algorithm>
#include <utility>

#include "base/errors.hpp"

namespace strut::deck {

void check_one_of(const Values& values, const Key& one, const Key& other, Problems& problems) {
  if (values.given(one) && values.given(other)) {
    problems.add(values.path(), "'" + one.name + "' and '" + other.name + "' are both given; expected one of them");
  }
}

bool check_exactly_one(const Values& values, const Key& one, const Key& other, Problems& problems) {
  check_one_of(values, one, other, problems);
  if (values.given(one) || values.given(other)) return values.given(one) != values.given(other);
  problems.add(values.path_to(one), "missing; " + expected(one) + ", or '" + other.name + "' in its place");
  return false;
}

int find_name(const Values& section, const Key& key, const std::string& wanted, const std::vector<std::string>& names,
              const std::string& where, Problems& problems) {
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found != names.end() || !section.has(key)) return static_cast<int>(found - names.begin());
  problems.add(section.path_to(key), "'" + wanted + "' is not defined" + did_you_mean(wanted, names) +
                                         "; expected the name of a section of " + where +
                                         (names.empty() ? "" : ": " + joined(names)));
  return 0;
}

namespace {

std::string without_either(int parts) {
  return parts > 0 ? " Default 1/" + std::to_string(parts) + " of the solver's time." : "";
}

}  // namespace

WhenKeys::WhenKeys(const std::string& prefix, int parts_of_a_solver)
    : frequency({.name = prefix + "Frequency",
                 .unit = "steps",
                 .range = {.low = 1},
                 .meaning = "Steps between two. Not together with " + prefix + "Interval."}),
      interval({.name = prefix + "Interval",
                .unit = "s",
                .range = positive,
                .meaning = "Simulated time between two." + without_either(parts_of_a_solver)}),
      parts(parts_of_a_solver) {}

Key without_effect(Key key, const std::string& why) {
  key.meaning = "Accepted for Peridigm's decks; no effect: " + why + ".";
  key.no_effect = why;
  return key;
}

Key verbose_without_effect() {
  return without_effect({.name = "Verbose", .kind = Kind::boolean, .fallback = "false"},
                        "the program says what it does at all times");
}

}  // namespace strut::deck
