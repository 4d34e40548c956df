// A value for each point; values shared by many points are stored once.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

namespace strut {

// Rounds to a multiple of the power of two at or below 2⁻ᵇⁱᵗˢ times a positive size: values that differ only by
// round-off become equal, or one of two.
inline double rounded(double value, double size, int bits) {
  const double unit = std::ldexp(1.0, std::ilogb(size) - bits);
  return std::rint(value / unit) * unit;
}

// T has `count` doubles from data() on. Values are equal if they agree to the last bit.
template <class T>
class Deduplicated {
 public:
  Deduplicated() = default;
  explicit Deduplicated(std::vector<T> all) {
    std::map<Bits, int> known;
    which_.reserve(all.size());
    for (const T& value : all) {
      const int next = static_cast<int>(values_.size());
      const int index = known.emplace(bits_of(value), next).first->second;
      if (index == next) values_.push_back(value);
      which_.push_back(index);
    }
    if (4 * values_.size() < 3 * all.size()) {
      values_.shrink_to_fit();
    } else {  // indices would cost more memory than they save
      values_ = std::move(all);
      which_ = std::vector<int>();
    }
    shared_ = values_.size();
  }

  const T& operator[](std::size_t i) const { return values_[which_.empty() ? i : which_[i]]; }
  // Sets the value of one point only.
  void set(std::size_t i, const T& value) {
    if (which_.empty()) {
      values_[i] = value;
    } else if (static_cast<std::size_t>(which_[i]) >= shared_) {  // was set before: not shared
      values_[which_[i]] = value;
    } else {
      which_[i] = static_cast<int>(values_.size());
      values_.push_back(value);
    }
  }
  double bytes() const { return static_cast<double>(values_.size() * sizeof(T) + which_.size() * sizeof(int)); }

 private:
  using Bits = std::array<std::uint64_t, T::SizeAtCompileTime>;
  static Bits bits_of(const T& value) {
    Bits bits;
    std::memcpy(bits.data(), value.data(), sizeof bits);
    return bits;
  }

  std::vector<T> values_;
  std::vector<int> which_;  // indices in values_; empty: one value per point
  std::size_t shared_ = 0;  // number of values that several points may share
};

}  // namespace strut
