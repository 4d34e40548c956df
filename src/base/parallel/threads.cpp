#include "base/parallel/threads.hpp"

#include <mpi.h>
#include <unistd.h>

#include <exception>
#include <string>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace strut {

namespace {

int thread_count = 1;

// The reason why there cannot be so many threads; empty if there can.
std::string what_forbids(int count) {
  if (count < 1 || count > most_threads) return "expected 1 to " + std::to_string(most_threads);
  if (count == 1) return "";
#ifdef _OPENMP
  int level = MPI_THREAD_SINGLE;
  MPI_Query_thread(&level);
  if (level < MPI_THREAD_FUNNELED) return "this MPI allows its ranks one thread only";
  if (omp_get_thread_limit() < count) return "OMP_THREAD_LIMIT is " + std::to_string(omp_get_thread_limit());
  return "";
#else
  return "this strut was built without OpenMP";
#endif
}

}  // namespace

std::string set_threads(int count) {
  const std::string problem = what_forbids(count);
  if (!problem.empty()) return "there cannot be " + std::to_string(count) + " threads a rank: " + problem;
  thread_count = count;
  return "";
}

int threads() { return thread_count; }

int cores_of_node() { return static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)); }

#ifdef _OPENMP

int this_thread() { return omp_get_thread_num(); }

int cores() { return omp_get_num_procs(); }

bool goes_alone() { return thread_count == 1 || omp_in_parallel() != 0; }

void side_by_side(int count, const std::function<void(int i)>& work) {
  if (goes_alone() || count < 2) {
    for (int i = 0; i < count; ++i) work(i);
    return;
  }
  int first = count;  // index of the error
  std::exception_ptr error;
#pragma omp parallel for schedule(static) num_threads(thread_count)
  for (int i = 0; i < count; ++i) {
    try {
      work(i);
    } catch (...) {
#pragma omp critical
      if (i < first) first = i, error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);
}

#else

int this_thread() { return 0; }

int cores() { return 1; }

bool goes_alone() { return true; }

void side_by_side(int count, const std::function<void(int i)>& work) {
  for (int i = 0; i < count; ++i) work(i);
}

#endif

}  // namespace strut
