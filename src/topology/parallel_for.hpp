// Loops over points by the threads of this rank (base/parallel/threads.hpp). Each index writes only its own data, and
// none calls MPI or a timer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/parallel/threads.hpp"

namespace strut {

namespace chunks {

// Number of parts of [begin, end), one per thread: a thread gets the same indices in each loop, so their values are in
// its cache. A single part if another thread is not worthwhile.
inline int count(int begin, int end) {
  constexpr int least = 16;
  return goes_alone() ? 1 : std::min((end - begin) / least, threads());
}

// Calls work(chunk, its begin, its end) for each part.
template <class Work>
void over(int count, int begin, int end, const Work& work) {
  if (count < 2) return work(0, begin, end);
  const auto start = [=](int c) { return begin + static_cast<int>(std::int64_t{end - begin} * c / count); };
  side_by_side(count, [&](int c) { work(c, start(c), start(c + 1)); });
}

}  // namespace chunks

// Calls work(i) for every i in [begin, end), in any order.
template <class Work>
void for_each_point(int begin, int end, const Work& work) {
  chunks::over(chunks::count(begin, end), begin, end, [&work](int, int first, int last) {
    for (int i = first; i < last; ++i) work(i);
  });
}

// The largest value(i) of [begin, end), at least `floor`.
template <class Value>
double largest(int begin, int end, double floor, const Value& value) {
  const auto of_part = [floor, &value](int first, int last) {
    double best = floor;
    for (int i = first; i < last; ++i) {
      const double candidate = value(i);
      if (candidate > best) best = candidate;
    }
    return best;
  };
  const int count = chunks::count(begin, end);
  if (count < 2) return of_part(begin, end);
  std::vector<double> best(static_cast<std::size_t>(count));
  chunks::over(count, begin, end,
               [&](int chunk, int first, int last) { best[static_cast<std::size_t>(chunk)] = of_part(first, last); });
  return *std::max_element(best.begin(), best.end());
}

// Σ value(i) over [begin, end) by one thread, so that the sum has a fixed order.
template <class Value>
double total(int begin, int end, const Value& value) {
  double sum = 0;
  for (int i = begin; i < end; ++i) sum += value(i);
  return sum;
}

}  // namespace strut
