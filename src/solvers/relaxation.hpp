// Equilibrium by dynamic relaxation: motion under the forces that are left, with masses that let all parts of the body
// keep pace with each other and a damping that adapts to the slowest of them. It needs no tangent.
#pragma once

#include "solvers/search.hpp"
#include "solvers/stable_step.hpp"

namespace strut {

class Relaxation {
 public:
  Relaxation(Equilibrium& equilibrium, const Audience& audience) : equilibrium_(equilibrium), audience_(audience) {}

  // Of iterations, which are some thousand times Newton's.
  static int most(const Tolerance& tolerance) { return 1000 * tolerance.most_iterations; }

  // Collective. From the present places, within the step that the equilibrium has begun.
  Search solve(const Tolerance& tolerance, int most);

  void begin_anew() { stable_ = {}; }  // the next search does not depend on earlier ones

 private:
  void renew_masses();

  Equilibrium& equilibrium_;
  const Audience& audience_;
  StableStep stable_;
  std::vector<double> masses_;  // N/m: of points, in a time whose unit is one iteration
};

}  // namespace strut
