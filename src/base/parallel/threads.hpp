// The threads of a rank: one, unless a run asks for more (strut --threads). They are OpenMP's, of the compiler,
// whatever Kokkos was built with. MPI, timers and files are for the main thread alone, outside of side_by_side.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace strut {

constexpr int most_threads = 1024;

// Of each rank from now on, 1 … most_threads. Returns why there cannot be so many; nothing where there can.
std::string set_threads(int count);
int threads();

// The one that calls: 0 … threads() − 1, outside of side_by_side 0.
int this_thread();

// Cores that this rank may use, and those of its node.
int cores();
int cores_of_node();

// Whether side_by_side would go one by one: there is one thread, or this is one of several already.
bool goes_alone();

// work(i), i = 0 … count − 1: each thread of this rank takes as many i in a row, the same ones every time, so that what
// they use stays in its core's cache. Called from within such a work, it runs all i on the calling thread. What is
// thrown reaches the caller when all is done: of several errors that of the least i.
void side_by_side(int count, const std::function<void(int i)>& work);

// A value for each thread, so that none waits for another.
template <class T>
class PerThread {
 public:
  PerThread() : values_(static_cast<std::size_t>(threads())) {}
  T& mine() { return values_[static_cast<std::size_t>(this_thread())]; }
  const std::vector<T>& all() const { return values_; }

 private:
  std::vector<T> values_;
};

}  // namespace strut
