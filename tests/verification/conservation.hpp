// The quantities that a free body must keep while it moves: momentum, and the balance of energy.
#pragma once

#include "integrators/explicit/central_difference.hpp"
#include "larger.hpp"

namespace strut {

struct Conservation {
  double momentum_drift = 0, balance_error = 0;  // the largest; drift: as a part of the first momentum
  Ledger last;
};

// Collective. Runs to the final time.
inline Conservation run_free(CentralDifference& solver, double final_time) {
  Conservation found;
  Vector start = Vector::Zero();
  for (;;) {
    solver.advance_velocity(final_time);
    found.last = solver.ledger();
    if (solver.steps() == 0) start = found.last.momentum;
    const double drift = (found.last.momentum - start).norm() / start.norm();
    found.momentum_drift = larger(found.momentum_drift, drift);
    found.balance_error = larger(found.balance_error, found.last.balance_error);
    if (solver.time() >= final_time) return found;
    solver.advance_position(true);
  }
}

}  // namespace strut
