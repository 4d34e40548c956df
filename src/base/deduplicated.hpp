// A value for each point, where those of many are the same: these are kept once.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

namespace strut {

// To a multiple of the power of two that is 2⁻ᵇⁱᵗˢ of a size above zero, or less: what differs by round-off alone
// becomes the same, or one of two.
inline double rounded(double value, double size, int bits) {
  const double unit = std::ldexp(1.0, std::ilogb(size) - bits);
  return std::rint(value / unit) * unit;
}

// T: of so many doubles from data() on. Values are the same where they are to the last bit.
template <class T>
class Deduplicated {
 public:
  Deduplicated() = default;
  explicit Deduplicated(std::vector<T> all) {
    std::map<Bits, int> known;
    which_.reserve(all.size());
    for (const T& value : all) {
      const int next = static_cast<int>(values_.size());
      const int place = known.emplace(bits_of(value), next).first->second;
      if (place == next) values_.push_back(value);
      which_.push_back(place);
    }
    if (4 * values_.size() < 3 * all.size()) {
      values_.shrink_to_fit();
    } else {  // places would cost more than they save
      values_ = std::move(all);
      which_ = std::vector<int>();
    }
    shared_ = values_.size();
  }

  const T& operator[](std::size_t i) const { return values_[which_.empty() ? i : which_[i]]; }
  // Of one point, whatever others have.
  void set(std::size_t i, const T& value) {
    if (which_.empty()) {
      values_[i] = value;
    } else if (static_cast<std::size_t>(which_[i]) >= shared_) {  // has been set before: its own
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
  std::vector<int> which_;  // of values_; empty: the points' own
  std::size_t shared_ = 0;  // so many of the values may be of several points
};

}  // namespace strut
