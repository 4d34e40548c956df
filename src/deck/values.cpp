#include "deck/values.hpp"

#include <algorithm>
#include <stdexcept>

#include "deck/problems.hpp"

namespace strut::deck {

namespace {

bool declares(const Section* section, const Key& key) {
  const auto same = [&key](const Key& one) { return one.name == key.name && one.kind == key.kind; };
  return section && (std::any_of(section->keys.begin(), section->keys.end(), same) ||
                     (section->any_key && same(*section->any_key)));
}

bool declares_section(const Section* section, const std::string& name) {
  const auto same = [&name](const Section& one) { return one.name == name; };
  return section && std::any_of(section->sections.begin(), section->sections.end(), same);
}

}  // namespace

void Values::expect_declared(const Key& key) const {
  if (!section_ || declares(section_, key) || declares(case_, key)) return;
  throw std::logic_error("the key '" + key.name + "' is not declared in the section '" + path_ + "'");
}

void Values::expect_declared_section(const std::string& name) const {
  if (!section_ || declares_section(section_, name) || declares_section(case_, name)) return;
  throw std::logic_error("the section '" + name + "' is not declared in the section '" + path_ + "'");
}

std::string Values::path_to(const Key& key) const {
  expect_declared(key);
  return deck::path_to(path_, key.name);
}

const Values::Entry* Values::entry(const std::string& key) const {
  for (const Entry& entry : entries_) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

const Value* Values::value(const std::string& key) const {
  const Entry* found = entry(key);
  return found ? &found->value : nullptr;
}

bool Values::given(const Key& key) const {
  expect_declared(key);
  const Entry* found = entry(key.name);
  return found && found->given;
}

bool Values::has(const Key& key) const {
  expect_declared(key);
  const Value* found = value(key.name);
  return found && !std::holds_alternative<std::monostate>(*found);
}

const Values* Values::find_section(const std::string& name) const {
  expect_declared_section(name);
  for (const Values& values : sections_) {
    if (values.name() == name) return &values;
  }
  return nullptr;
}

bool Values::has_section(const std::string& name) const {
  const Values* found = find_section(name);
  return found && found->given_;
}

const Values& Values::section(const std::string& name) const {
  static const Values nothing;
  const Values* found = find_section(name);
  return found ? *found : nothing;
}

}  // namespace strut::deck
