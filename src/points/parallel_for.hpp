// Loops over points, by the threads of this rank (base/parallel/threads.hpp). Each index writes what is its own, and
// none calls MPI or a timer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/parallel/threads.hpp"

namespace strut {

// What a loop does at an index. Heavy: a material law, a family of neighbors. Light: some sums of the index's own
// values, which take less time than another thread takes to begin, and to fetch them from another core.
enum class LoopWork { heavy, light };

namespace chunks {

// Parts of [begin, end), one a thread: a thread comes to the same indices in each loop, so it has their values in its
// cache. One part alone where that is not worth another thread's while.
inline int count(int begin, int end, LoopWork kind) {
  const int least = kind == LoopWork::heavy ? 16 : 1024;
  return goes_alone() ? 1 : std::min((end - begin) / least, threads());
}

// act(chunk, its begin, its end).
template <class Act>
void over(int count, int begin, int end, const Act& act) {
  if (count < 2) return act(0, begin, end);
  const auto start = [=](int c) { return begin + static_cast<int>(std::int64_t{end - begin} * c / count); };
  side_by_side(count, [&](int c) { act(c, start(c), start(c + 1)); });
}

}  // namespace chunks

// act(i) for every i in [begin, end), in any order.
template <class Act>
void for_each_point(int begin, int end, const Act& act, LoopWork kind = LoopWork::heavy) {
  chunks::over(chunks::count(begin, end, kind), begin, end, [&act](int, int first, int last) {
    for (int i = first; i < last; ++i) act(i);
  });
}

// The largest value(i) of [begin, end), at least `floor`.
template <class Value>
double largest(int begin, int end, double floor, const Value& value, LoopWork kind = LoopWork::heavy) {
  const auto of_part = [floor, &value](int first, int last) {
    double best = floor;
    for (int i = first; i < last; ++i) {
      const double candidate = value(i);
      if (candidate > best) best = candidate;
    }
    return best;
  };
  const int count = chunks::count(begin, end, kind);
  if (count < 2) return of_part(begin, end);
  std::vector<double> best(static_cast<std::size_t>(count));
  chunks::over(count, begin, end,
               [&](int chunk, int first, int last) { best[static_cast<std::size_t>(chunk)] = of_part(first, last); });
  return *std::max_element(best.begin(), best.end());
}

// Σ value(i) over [begin, end), by one thread: a sum has an order.
template <class Value>
double total(int begin, int end, const Value& value) {
  double sum = 0;
  for (int i = begin; i < end; ++i) sum += value(i);
  return sum;
}

}  // namespace strut
