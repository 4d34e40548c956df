// Inside io: names in the form of the Exodus library, their numbers, and errors about a file.
#pragma once

#include <cctype>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.hpp"

namespace strut::io {

[[noreturn]] inline void fail_at(const std::filesystem::path& path, std::string_view doing, const std::string& cause) {
  throw Error(path.string() + ": cannot " + std::string(doing) + ": " + cause);
}

// Types of elements are compared in capitals: their spelling depends on the code that wrote them.
inline std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// The library exchanges names as arrays of pointers to buffers of equal length.
class NameTable {
 public:
  // `longest`: bytes of a name.
  NameTable(std::size_t count, std::size_t longest)
      : width_(longest + 1), buffer_(count * width_, '\0'), pointers_(count) {
    for (std::size_t i = 0; i < count; ++i) pointers_[i] = buffer_.data() + i * width_;
  }
  NameTable(const std::vector<std::string>& names, std::size_t longest) : NameTable(names.size(), longest) {
    for (std::size_t i = 0; i < names.size(); ++i) names[i].copy(pointers_[i], width_ - 1);
  }
  char** data() { return pointers_.data(); }
  std::string operator[](std::size_t i) const { return pointers_[i]; }
  std::vector<std::string> names() const { return {pointers_.begin(), pointers_.end()}; }

 private:
  std::size_t width_;
  std::vector<char> buffer_;
  std::vector<char*> pointers_;
};

inline std::string quoted(const std::string& name, std::int64_t id) {
  return name.empty() ? std::to_string(id) : "'" + name + "'";
}

// Exodus needs numbers beside names. A reader calls the unnamed block 7 "block_7": if all names are of this form and
// distinct, these are their numbers; else 1, 2, …
inline std::vector<std::int64_t> numbers_of(const std::vector<std::string>& names, const std::string& prefix) {
  std::set<std::int64_t> distinct;
  std::vector<std::int64_t> numbers;
  for (const std::string& name : names) {
    int number = 0;
    if (name.starts_with(prefix)) std::from_chars(name.data() + prefix.size(), name.data() + name.size(), number);
    if (number > 0 && name == prefix + std::to_string(number)) distinct.insert(number);
    numbers.push_back(number);
  }
  if (distinct.size() != names.size()) std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

// Reports blocks, or node sets, with the same number or name: the library finds them by number, the deck by name. "" if
// there are none.
template <class Item, class Named>
std::string said_twice(const std::string& kind, const std::vector<Item>& items, const std::vector<Named>& named) {
  std::map<std::int64_t, std::size_t> numbers;
  std::map<std::string, std::size_t> names;
  const auto described = [&](std::size_t k) {
    return "'" + named[k].name + "' (number " + std::to_string(items[k].id) + ", at place " + std::to_string(k + 1) +
           ")";
  };
  for (std::size_t k = 0; k < items.size(); ++k) {
    const auto [number, is_new_number] = numbers.emplace(items[k].id, k);
    const auto [name, is_new_name] = names.emplace(named[k].name, k);
    if (is_new_number && is_new_name) continue;
    const std::size_t first = is_new_number ? name->second : number->second;
    return kind + "s " + described(first) + " and " + described(k) + " have the same " +
           (is_new_number ? "name" : "number") + "; expected one of its own for each " + kind;
  }
  return "";
}

}  // namespace strut::io
