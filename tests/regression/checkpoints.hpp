// Runs that go on from each of their checkpoints.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "regression/bodies.hpp"

namespace strut::regression {

// Collective. Expects a number of the ledger to have the same bits `further` steps after each checkpoint, which are
// `every` steps apart, as without one. Returns it at all steps.
inline std::vector<double> expect_same_after_checkpoints(const RunFolder& folder, const Parts& parts,
                                                         double Ledger::*number, int every = 1, int further = 1) {
  Simulation whole(folder, parts);
  const double end = whole.deck.solver.final_time;
  std::vector<Snapshot> kept;
  std::vector<double> numbers;
  while (whole.solver.time() < end) {
    if (numbers.size() % every == 0) {
      Archive saved = Archive::saving_to(kept.emplace_back());
      whole.solver.serialize(saved);
    }
    whole.solver.advance_velocity(end);
    numbers.push_back(whole.solver.ledger().*number);
    whole.solver.advance_position(true);
  }
  for (std::size_t m = 0; m * every + further < numbers.size(); ++m) {
    Simulation other(folder, parts);
    Archive restored = Archive::loading_from(kept[m]);
    other.solver.serialize(restored);
    for (int n = 0; n < further; ++n) {
      other.solver.advance_velocity(end);
      other.solver.advance_position(true);
    }
    other.solver.advance_velocity(end);
    EXPECT_EQ(other.solver.ledger().*number, numbers[m * every + further]) << m;
  }
  return numbers;
}

}  // namespace strut::regression
