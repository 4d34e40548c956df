// Forces of explicit steps as means over the times between the rows of the history: times these, they are impulses.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "base/parallel/communicator.hpp"

namespace strut {

class MeanForces {
 public:
  MeanForces(std::size_t columns, double initial_time) : since_(initial_time), passed_(columns), ahead_(columns) {}

  // This rank's impulses at a time of the solver, N s, a column each: what of them is before it, and what is after it.
  void add(std::span<const double> before, std::span<const double> after);
  // Collective; at the time of a row, after add(): N, over all ranks, from the row before to this one. In the first row
  // there is no time that a force could have acted for: 0.
  std::vector<double> take(double time, const Communicator& communicator);

  void serialize(Archive& archive);

 private:
  double since_;                // s, the time of the last row
  std::vector<double> passed_;  // N s, from there to the last time
  std::vector<double> ahead_;   // N s, of the last time, after it
};

}  // namespace strut
