#include "deck/values.hpp"

namespace strut::deck {

const Values::Entry* Values::entry(const std::string& key) const {
  for (const Entry& entry : entries_) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

bool Values::given(const std::string& key) const {
  const Entry* found = entry(key);
  return found && found->given;
}

bool Values::has(const std::string& key) const {
  const Entry* found = entry(key);
  return found && !std::holds_alternative<std::monostate>(found->value);
}

std::vector<std::string> Values::keys() const {
  std::vector<std::string> keys;
  for (const Entry& entry : entries_) keys.push_back(entry.key);
  return keys;
}

const Values* Values::find(const std::string& section) const {
  for (const Values& values : sections_) {
    if (values.name() == section) return &values;
  }
  return nullptr;
}

bool Values::has_section(const std::string& name) const {
  const Values* found = find(name);
  return found && found->given_;
}

const Values& Values::section(const std::string& name) const {
  static const Values nothing("", "");
  const Values* found = find(name);
  return found ? *found : nothing;
}

}  // namespace strut::deck
