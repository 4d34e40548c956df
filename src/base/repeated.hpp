// A value for each point, where those of many are alike but for round-off: these are kept once.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace strut {

// T: of so many doubles from data() on.
template <class T>
class Repeated {
 public:
  static constexpr int size = T::SizeAtCompileTime;
  using Sizes = std::array<double, size>;  // of each number of a value, how large it may be

  Repeated() = default;
  // sizes_of(value), above zero: numbers that are the same but for 2⁻⁴⁰ of these count as alike. may_share(i): of point
  // i.
  template <class SizesOf, class MayShare>
  Repeated(std::vector<T> all, const SizesOf& sizes_of, const MayShare& may_share) {
    std::map<Rounded, int> known;
    which_.reserve(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const int next = static_cast<int>(values_.size());
      const int place = may_share(i) ? known.emplace(rounded(all[i], sizes_of(all[i])), next).first->second : next;
      if (place == next) values_.push_back(all[i]);
      which_.push_back(place);
    }
    if (4 * values_.size() < 3 * all.size()) {
      values_.shrink_to_fit();
    } else {  // places would cost more than they save
      values_ = std::move(all);
      which_ = std::vector<int>();
    }
  }

  const T& operator[](std::size_t i) const { return values_[which_.empty() ? i : which_[i]]; }
  double bytes() const { return static_cast<double>(values_.size() * sizeof(T) + which_.size() * sizeof(int)); }

 private:
  // Each number as so many times a power of two, and which.
  using Rounded = std::array<std::int64_t, 2 * size>;
  static Rounded rounded(const T& value, const Sizes& sizes) {
    Rounded result;
    for (int k = 0; k < size; ++k) {
      const int unit = std::ilogb(sizes[k]) - 40;
      result[2 * k] = std::llrint(std::ldexp(value.data()[k], -unit));
      result[2 * k + 1] = unit;
    }
    return result;
  }

  std::vector<T> values_;
  std::vector<int> which_;  // of values_; empty: the points' own
};

}  // namespace strut
