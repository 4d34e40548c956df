// A section of a deck after checking: the values of its keys in their declared types, with defaults.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "deck/keys.hpp"

namespace strut::deck {

// monostate if the value in the deck is wrong.
using Value = std::variant<std::monostate, bool, int, double, std::vector<double>, Vector, std::vector<int>,
                           std::string, std::vector<std::string>, Function>;

// Access to a key or section that is not declared is a programming error, std::logic_error. A missing section, which
// has been reported, returns empty values.
class Values {
 public:
  Values() = default;  // for a missing section
  Values(std::string name, std::string path, const Section& section)
      : name_(std::move(name)), path_(std::move(path)), section_(&section) {}

  const std::string& name() const { return name_; }
  const std::string& path() const { return path_; }
  std::string path_to(const Key& key) const;

  bool given(const Key& key) const;  // in the deck, right or wrong
  bool has(const Key& key) const;    // valid, or by default

  // The value; zero, empty or false if has(key) is false, so that checks can continue after a problem.
  template <class T>
  T operator[](const TypedKey<T>& key) const {
    const T* value = find<T>(key);
    return value ? with_path(*value, key) : nothing<T>();
  }

  template <class T>
  std::optional<T> operator[](const OptionalKey<T>& key) const {
    const T* value = find<T>(key);
    return value ? std::optional<T>(with_path(*value, key)) : std::nullopt;
  }

  template <class T>
  T operator[](const ChoiceKey<T>& key) const {
    const std::string* choice = find<std::string>(key);
    for (const auto& [text, value] : key.values) {
      if (choice && *choice == text) return value;
    }
    return T{};
  }

  // The parameters that the user names, in the deck's order.
  template <class T>
  std::vector<std::pair<std::string, T>> all(const AnyKey<T>& key) const {
    std::vector<std::pair<std::string, T>> all;
    expect_declared(key);
    for (const Entry& entry : entries_) {
      const T* value = std::get_if<T>(&entry.value);
      all.emplace_back(entry.key, value ? *value : nothing<T>());
    }
    return all;
  }

  // The case that the selector names; "" if it names none.
  std::string chosen() const { return case_ ? case_->name : ""; }

  const std::vector<Values>& sections() const { return sections_; }

  // A section that the deck has, or that has no required keys: an absent one then counts as an empty one.
  const Values* find_section(const std::string& name) const;
  const Values& section(const std::string& name) const;  // empty if find_section() finds nothing
  bool has_section(const std::string& name) const;       // in the deck

  // All values that have an effect, and the sections of the deck, as text by their paths: to compare two decks.
  static constexpr const char* section_text = "a section";
  void add_texts(std::map<std::string, std::string>& texts) const;

  // To fill it:
  void set(const std::string& key, Value value, bool given) { entries_.push_back({key, std::move(value), given}); }
  void choose(const Section* one) { case_ = one; }
  const Value* value(const std::string& key) const;  // null if nothing is set
  void add(Values section, bool given) {
    sections_.push_back(std::move(section));
    sections_.back().given_ = given;
  }

 private:
  struct Entry {
    std::string key;
    Value value;
    bool given;
  };
  const Entry* entry(const std::string& key) const;
  void expect_declared(const Key& key) const;
  void expect_declared_section(const std::string& name) const;

  template <class T>
  const T* find(const Key& key) const {
    expect_declared(key);
    return std::get_if<T>(value(key.name));
  }

  // An expression knows its path, for messages later in the run, too.
  template <class T>
  T with_path(T value, const Key& key) const {
    if constexpr (std::is_same_v<T, Function>) value.set_path(path_to(key));
    return value;
  }

  template <class T>
  static T nothing() {
    if constexpr (std::is_same_v<T, Vector>) return Vector::Zero();
    return T{};
  }

  std::string name_, path_;
  const Section* section_ = nullptr;
  const Section* case_ = nullptr;
  bool given_ = true;
  std::vector<Entry> entries_;
  std::vector<Values> sections_;
};

// One case of a selector: its keys and sections, and what it makes of their values.
template <class Made, class... More>
struct Case {
  Section schema;  // named by the values of the selector
  Made (*make)(const Values& values, More... more);
};

// The entry of a table of cases (schemas_of) that the selector names; null if it names none.
template <class Entry>
const Entry* chosen_of(const std::vector<Entry>& entries, const Values& values) {
  for (const Entry& entry : entries) {
    if (entry.schema.name == values.chosen()) return &entry;
  }
  return nullptr;
}

// A section whose key "Type" selects an entry of such a table.
// The first entry is the default.
template <class Entry>
Section one_of(const std::string& name, const std::string& meaning, const std::vector<Entry>& entries) {
  Key type = {.name = "Type", .fallback = entries.front().schema.name, .meaning = "Form."};
  return with_cases({.name = name, .meaning = meaning}, std::move(type), schemas_of(entries));
}

// The object that the selected entry makes; that of the first entry if the selection itself is wrong.
template <class Made, class... More>
Made make_one_of(const std::vector<Case<Made, More...>>& entries, const Values& values, More... more) {
  const Case<Made, More...>* entry = chosen_of(entries, values);
  return (entry ? *entry : entries.front()).make(values, more...);
}

}  // namespace strut::deck
