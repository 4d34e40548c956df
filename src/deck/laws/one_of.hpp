// A section whose key "Type" selects an entry of a table; each entry has a schema, and makes an object from the
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
  Key type = {.name = "Type", .fallback = entries.front().schema.name, .meaning = "Form."};
  return with_cases({.name = name, .meaning = meaning}, std::move(type), schemas_of(entries));
}

// The object that the selected entry makes; that of the first entry if the selection itself is wrong.
template <class Entry>
auto make_one_of(const std::vector<Entry>& entries, const Values& values) {
  const Entry* entry = chosen_of(entries, values);
  return (entry ? *entry : entries.front()).make(values);
}

}  // namespace strut::deck
