// Random numbers that are the same on every machine: the seed and the number of an input identify it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace strut::fuzz {

class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t number = 0) : state_(seed * 0x9e3779b97f4a7c15u + number) {
    for (int i = 0; i < 3; ++i) next();
  }

  std::uint64_t next() {  // splitmix64
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }

  std::size_t below(std::size_t n) { return n == 0 ? 0 : next() % n; }
  bool chance(double p) { return static_cast<double>(next() >> 11) * 0x1p-53 < p; }

  template <class T>
  const T& pick(const std::vector<T>& all) {
    return all[below(all.size())];
  }

 private:
  std::uint64_t state_;
};

}  // namespace strut::fuzz
