#include "deck/sections/two_keys.hpp"

#include <algorithm>

#include "base/errors.hpp"

namespace strut::deck {

void check_one_of(const Values& values, const Key& one, const Key& other, Problems& problems) {
  if (values.given(one) && values.given(other)) {
    problems.add(values.path(), "'" + one.name + "' and '" + other.name + "' are both given; expected one of them");
  }
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

}  // namespace strut::deck
