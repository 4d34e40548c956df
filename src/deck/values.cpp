#include "deck/values.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <type_traits>

#include "base/numbers.hpp"
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

std::string text_of(const Value& value) {
  const auto text = []<class T>(const T& one) -> std::string {
    const auto list = [&one](const auto& text_of_item) {
      std::string all;
      for (const auto& item : one) all += (all.empty() ? "" : " ") + text_of_item(item);
      return all;
    };
    if constexpr (std::is_same_v<T, bool>) return one ? "true" : "false";
    if constexpr (std::is_same_v<T, int> || std::is_same_v<T, double>) return to_text(one);
    if constexpr (std::is_same_v<T, std::string>) return one;
    if constexpr (std::is_same_v<T, std::vector<std::string>>) return list([](const auto& item) { return item; });
    if constexpr (std::is_same_v<T, std::vector<int>>) {  // axes
      return list([](int axis) { return std::string(1, "xyz"[axis]); });
    }
    if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, Vector>) {
      return list([](double item) { return to_text(item); });
    }
    if constexpr (std::is_same_v<T, Function>) {
      if (one.is_constant()) return to_text(one(0, 0, 0, 0));
      std::string expression = one.text();
      std::erase_if(expression, [](unsigned char c) { return std::isspace(c) != 0; });
      return expression;
    }
    return "";
  };
  return std::visit(text, value);
}

bool has_effect(const Section* section, const std::string& key) {
  const auto is_without = [&key](const Key& one) { return one.name == key && !one.no_effect.empty(); };
  return !section || std::none_of(section->keys.begin(), section->keys.end(), is_without);
}

}  // namespace

void Values::add_texts(std::map<std::string, std::string>& texts) const {
  if (given_ && !path_.empty()) texts[path_] = section_text;
  for (const Entry& entry : entries_) {
    if (has_effect(section_, entry.key) && has_effect(case_, entry.key))
      texts[deck::path_to(path_, entry.key)] = text_of(entry.value);
  }
  for (const Values& section : sections_) section.add_texts(texts);
}

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
