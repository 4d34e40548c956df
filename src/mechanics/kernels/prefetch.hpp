// Prefetches records that are read later, a few cache lines at a time. A processor waits for only some lines at once:
// more of them in a row would hold up the arithmetic beside them.
#pragma once

#include <array>
#include <cstddef>

namespace strut {

class Prefetch {
 public:
  // Adds `count` consecutive records, also beyond the end of an array: prefetching no memory does nothing.
  template <class Record>
  void add(const Record* first, std::size_t count) {
    const char* begin = reinterpret_cast<const char*>(first);
    ranges_[count_++] = {begin, begin + count * sizeof(Record)};
    lines_ += (count * sizeof(Record) + line - 1) / line;
  }
  // Distributes the lines over so many calls of some().
  void spread_over(std::size_t calls) { at_once_ = calls == 0 ? lines_ : (lines_ + calls - 1) / calls; }
  void some() {
    for (std::size_t n = 0; n < at_once_; ++n) {
      while (ranges_[now_].begin >= ranges_[now_].end) {
        if (now_ == count_) return;
        ++now_;
      }
      __builtin_prefetch(ranges_[now_].begin);
      ranges_[now_].begin += line;
    }
  }
  void all() {
    spread_over(1);
    some();
  }

 private:
  static constexpr std::size_t line = 64, most = 8;
  struct Range {
    const char *begin = nullptr, *end = nullptr;
  };
  std::array<Range, most + 1> ranges_;  // the last stays empty
  std::size_t count_ = 0, lines_ = 0, at_once_ = 0, now_ = 0;
};

}  // namespace strut
