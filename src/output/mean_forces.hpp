// Mean forces of explicit steps between rows of the history; multiplied by the time in between they are impulses.
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

  // Adds this rank's impulses at a time of the solver, N s, one per column: the parts before and after that time.
  void add(std::span<const double> before, std::span<const double> after);
  // Collective; at the time of a row, after add(): mean forces from the previous row to this one, N, over all ranks. In
  // the first row, before which no force has acted, 0.
  std::vector<double> take(double time, const Communicator& communicator);

  void serialize(Archive& archive);

 private:
  double since_;                // s, the time of the last row
  std::vector<double> passed_;  // N s, from there to the last time
  std::vector<double> ahead_;   // N s, of the last time, the part after it
};

}  // namespace strut
