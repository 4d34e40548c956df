// A section whose key "Type" chooses among the entries of a table; each has a schema, and makes something of the
// values.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "deck/schema.hpp"
#include "deck/values.hpp"

namespace strut::deck {

// The first entry is the default.
template <class Entry>
Section one_of(const std::string& name, const std::string& meaning, const std::vector<Entry>& entries) {
  Key type = {.name = "Type", .fallback = entries.front().schema.name, .meaning = "The form; it decides on the keys."};
  return with_cases({.name = name, .meaning = meaning}, std::move(type), schemas_of(entries));
}

// What the chosen entry makes of `values`; of the first entry where the choice itself is among the problems.
template <class Entry>
auto make_one_of(const std::vector<Entry>& entries, const Values& values) {
  const Entry* entry = chosen_of(entries, values);
  return (entry ? *entry : entries.front()).make(values);
}

}  // namespace strut::deck
