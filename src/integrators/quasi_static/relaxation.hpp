// Equilibrium by dynamic relaxation: motion under the residual forces, with masses that make all parts of the body
// equally fast, and a damping that adapts to the slowest motion. It needs no tangent.
#pragma once

#include "integrators/explicit/critical_time_step.hpp"
#include "integrators/quasi_static/equilibrium.hpp"

namespace strut {

class Relaxation {
 public:
  Relaxation(Equilibrium& equilibrium, const Observer& observer) : equilibrium_(equilibrium), observer_(observer) {}

  // Largest number of iterations, a thousand times Newton's.
  static int most(const Tolerance& tolerance) { return 1000 * tolerance.most_iterations; }

  // Collective. Starts from the present positions, within the step that the equilibrium has begun.
  EquilibriumSearch solve(const Tolerance& tolerance, int most);

  void begin_anew() { critical_time_step_ = {}; }  // the next search does not depend on earlier ones

 private:
  void renew_masses();

  Equilibrium& equilibrium_;
  const Observer& observer_;
  CriticalTimeStep critical_time_step_;
  std::vector<double> masses_;  // N/m: of points; the unit of time is one iteration
};

}  // namespace strut
