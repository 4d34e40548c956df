// FNV-1a checksum of values, word by word: detects a changed bit on a disk or in a copy, and exchanged files.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace strut::io {

class CheckSum {
 public:
  template <class T>
  void add(std::span<const T> values) {
    static_assert(sizeof(T) == 8);
    for (const T& value : values) {
      std::uint64_t word;
      std::memcpy(&word, &value, 8);
      add(word);
    }
  }
  void add(double value) { add(std::span<const double>(&value, 1)); }
  void add(std::string_view text) {
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }

  double value() const { return static_cast<double>(sum_ >> 12); }  // the bits that a double holds exactly

 private:
  void add(std::uint64_t word) { sum_ = (sum_ ^ word) * 0x100000001b3u; }

  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

}  // namespace strut::io
