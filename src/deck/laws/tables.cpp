#include "deck/laws/tables.hpp"

#include "base/numbers.hpp"

namespace strut::deck {

namespace {

// The section gives the meanings, and the range of the stresses.
const RealsKey strains({.name = "Strains", .range = not_negative});
const RealsKey stresses({.name = "Stresses", .unit = "Pa"});

}  // namespace

std::vector<Key> table_keys(const std::string& of_strains, const std::string& of_stresses, Range range) {
  std::vector<Key> keys = {strains, stresses};
  keys[0].meaning = of_strains;
  keys[1].meaning = of_stresses;
  keys[1].range = range;
  return keys;
}

bool check_table(const Values& values, Problems& problems) {
  if (!values.has(strains) || !values.has(stresses)) return false;
  const auto [at, flow] = read_table(values);
  bool good = true;
  const auto wrong = [&](const std::string& what) {
    problems.add(values.path_to(strains), what);
    good = false;
  };
  if (at.size() != flow.size()) {
    wrong(std::to_string(at.size()) + " strains for " + std::to_string(flow.size()) + " stresses; expected as many");
  }
  if (at.front() != 0) wrong("the first is " + to_text(at.front()) + "; expected 0");
  for (std::size_t i = 1; i < at.size(); ++i) {
    if (at[i] > at[i - 1]) continue;
    wrong(to_text(at[i]) + " follows " + to_text(at[i - 1]) + "; expected rising strains");
  }
  return good;
}

materials::TableHardening read_table(const Values& values) {
  return {.strains = values[strains], .stresses = values[stresses]};
}

std::string path_to_stresses(const Values& values) { return values.path_to(stresses); }

}  // namespace strut::deck
