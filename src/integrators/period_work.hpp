// The work of the forces through periodic sides when their distance changes.
#pragma once

#include <vector>

#include "conditions/impulse_work.hpp"
#include "topology/domain.hpp"

namespace strut {

// A time at which forces act, the lengths of the steps before and after it (`before`: 0 at the start of a run), and the
// time over which the impulse of the forces acts; all in s.
struct TimeOfImpulse {
  double t, before, after, impulse;
};

// `forces`: of mechanics/mirror_forces.hpp, N; nothing without periods.
void add_period_work(const Domain& domain, const std::vector<Vector>& forces, const TimeOfImpulse& at,
                     ImpulseWork& work);

// The work from t over dt (s) between equilibria, J. `before`, `after`: the forces at these times.
double period_work(const Domain& domain, const std::vector<Vector>& before, const std::vector<Vector>& after, double t,
                   double dt);

}  // namespace strut
