// The threads of a rank: one, unless a run asks for more (strut --threads). They are the compiler's OpenMP threads,
// whatever Kokkos was built with. Only the main thread uses MPI, timers and files, outside of side_by_side.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace strut {

constexpr int most_threads = 1024;

// Sets the number of threads of each rank, 1 … most_threads; call it after MPI has started. Returns the reason if that
// number is impossible, else "".
std::string set_threads(int count);
int threads();

// The calling thread: 0 … threads() − 1, outside of side_by_side 0.
int this_thread();

// Cores that this rank may use, and cores of its node.
int cores();
int cores_of_node();

// True if side_by_side would run serially: there is only one thread, or this is one of several already.
bool goes_alone();

// Runs work(i), i = 0 … count − 1: each thread of this rank takes a contiguous range, the same in every call, so that
// its data stay in its core's cache. A nested call runs all i on the calling thread. Exceptions reach the caller when
// all are done; of several, that of the least i.
void side_by_side(int count, const std::function<void(int i)>& work);

// A value for each thread, so that no thread waits for another.
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
