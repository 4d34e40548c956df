// Loops over points on Kokkos' default host space. Only kernels (.cpp files) include this: Kokkos is slow to compile.
#pragma once

#include <Kokkos_Core.hpp>

namespace strut {

using HostRange = Kokkos::RangePolicy<Kokkos::DefaultHostExecutionSpace, Kokkos::IndexType<int>>;

// work(i) for every i in [begin, end), in any order.
template <class Work>
void for_each_point(int begin, int end, const Work& work) {
  Kokkos::parallel_for(HostRange(begin, end), work);
}

// The largest value(i) of [begin, end), at least `floor`.
template <class Value>
double largest(int begin, int end, double floor, const Value& value) {
  double result = floor;
  const auto keep = [&value](int i, double& best) {
    const double candidate = value(i);
    if (candidate > best) best = candidate;
  };
  Kokkos::parallel_reduce(HostRange(begin, end), keep, Kokkos::Max<double>(result));
  return std::max(result, floor);
}

// Σ value(i) over [begin, end).
template <class Value>
double total(int begin, int end, const Value& value) {
  double result = 0;
  Kokkos::parallel_reduce(
      HostRange(begin, end), [&value](int i, double& sum) { sum += value(i); }, result);
  return result;
}

}  // namespace strut
