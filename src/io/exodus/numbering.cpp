#include "io/exodus/numbering.hpp"

#include <charconv>
#include <numeric>
#include <set>

namespace strut::io {

std::vector<std::int64_t> numbers_of(const std::vector<std::string>& names, const std::string& prefix) {
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

}  // namespace strut::io
