// Checks that take two keys, or the name of another section.
#pragma once

#include <string>
#include <vector>

#include "deck/problems.hpp"
#include "deck/values.hpp"

namespace strut::deck {

// Reports where both keys are given.
void check_one_of(const Values& values, const Key& one, const Key& other, Problems& problems);

// The place of the name that `key` of the section gives in `names`, those of the sections of `where`.
int find_name(const Values& section, const TextKey& key, const std::vector<std::string>& names,
              const std::string& where, Problems& problems);

template <class Named>
int find_named(const Values& section, const TextKey& key, const std::vector<Named>& all, const std::string& where,
               Problems& problems) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return find_name(section, key, names, where, problems);
}

}  // namespace strut::deck
