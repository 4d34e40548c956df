// A section of a deck after checking: its keys as values of their declared types, defaults filled in.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/math/function.hpp"

namespace strut::deck {

// Nothing where the deck has a value that is among the problems.
using Value = std::variant<std::monostate, bool, int, double, std::vector<double>, std::string,
                           std::vector<std::string>, Function>;

class Values {
 public:
  Values(std::string name, std::string path) : name_(std::move(name)), path_(std::move(path)) {}

  const std::string& name() const { return name_; }
  const std::string& path() const { return path_; }

  bool given(const std::string& key) const;  // in the deck, be it right or wrong
  bool has(const std::string& key) const;    // right, or by default

  // The value; zero, empty or false where has(key) is false, so that checks can go on after a problem.
  bool flag(const std::string& key) const { return get<bool>(key); }
  int integer(const std::string& key) const { return get<int>(key); }
  double real(const std::string& key) const { return get<double>(key); }
  const std::vector<double>& reals(const std::string& key) const { return get<std::vector<double>>(key); }
  const std::string& text(const std::string& key) const { return get<std::string>(key); }
  const std::vector<std::string>& names(const std::string& key) const { return get<std::vector<std::string>>(key); }
  const Function& function(const std::string& key) const { return get<Function>(key); }

  std::vector<std::string> keys() const;  // in the deck's order, then those by default
  const std::vector<Values>& sections() const { return sections_; }

  // A section that the deck has, or that has no required keys: an absent one is then as good as an empty one.
  const Values* find(const std::string& section) const;
  const Values& section(const std::string& name) const;  // an empty one where find() finds nothing
  bool has_section(const std::string& name) const;       // in the deck

  void set(const std::string& key, Value value, bool given) { entries_.push_back({key, std::move(value), given}); }
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

  template <class T>
  const T& get(const std::string& key) const {
    static const T nothing{};
    const Entry* found = entry(key);
    const T* value = found ? std::get_if<T>(&found->value) : nullptr;
    return value ? *value : nothing;
  }

  std::string name_, path_;
  bool given_ = true;
  std::vector<Entry> entries_;
  std::vector<Values> sections_;
};

}  // namespace strut::deck
