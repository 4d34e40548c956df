#include "verification/probes.hpp"

#include <cmath>
#include <random>

#include "base/errors.hpp"

namespace strut {

void throw_apart(Body& body, double speed) {
  for (int i = 0; i < body.owned(); ++i) {
    std::mt19937 engine(static_cast<unsigned>(body.domain.cloud.ids[i]));
    std::uniform_real_distribution<double> uniform(-speed, speed);
    for (int c = 0; c < 3; ++c) body.velocity[i][c] = uniform(engine);
  }
}

bool stays_bounded(Body body, double factor) {
  const double limit = CentralDifference(body, {}, {}, {0, 1, false}, 0).critical_time_step();
  throw_apart(body, 1e-3);
  CentralDifference solver(body, {}, {}, {factor * limit, 0}, 0);
  try {
    for (int n = 0; n < 1000; ++n) {
      solver.advance_velocity(1e9);
      solver.advance_position(false);
    }
  } catch (const Error&) {
    return false;
  }
  return largest_over(body, [&](int i) { return body.velocity[i].norm(); }) < 1;
}

double pulse(double x) { return std::abs(x) < 1 ? std::pow(std::cos(0.5 * M_PI * x), 4) : 0; }

void run_until(CentralDifference& solver, double final_time) {
  while (solver.time() < final_time) {
    solver.advance_velocity(final_time);
    solver.advance_position(false);
  }
}

}  // namespace strut
