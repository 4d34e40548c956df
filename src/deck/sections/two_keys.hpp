// Checks that need two keys, or the name of another section.
#pragma once

#include <string>
#include <vector>

#include "deck/problems.hpp"
#include "deck/values.hpp"

namespace strut::deck {

// Reports if both keys are given.
void check_one_of(const Values& values, const Key& one, const Key& other, Problems& problems);

// The index of `wanted`, the value of `key`, in `names`, the sections of `where`; the number of names if there is
// none.
int find_name(const Values& section, const Key& key, const std::string& wanted, const std::vector<std::string>& names,
              const std::string& where, Problems& problems);

template <class Named>
int find_named(const Values& section, const Key& key, const std::string& wanted, const std::vector<Named>& all,
               const std::string& where, Problems& problems) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return find_name(section, key, wanted, names, where, problems);
}

template <class Named>
int find_named(const Values& section, const TextKey& key, const std::vector<Named>& all, const std::string& where,
               Problems& problems) {
  return find_named(section, key, section[key], all, where, problems);
}

}  // namespace strut::deck
