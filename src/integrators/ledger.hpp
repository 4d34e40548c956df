// The ledger: the energy balance of a run at one time.
#pragma once

#include <vector>

#include "conditions/impulse_work.hpp"
#include "mechanics/energies.hpp"

namespace strut {

struct Ledger {
  double time = 0, dt = 0;                                             // s
  double kinetic = 0, elastic = 0, dissipated = 0, stabilization = 0;  // J
  double fracture = 0;                                                 // J, dissipated by bonds that broke
  double jumps = 0;         // J, lost as a body, after bonds broke or cells softened, moved to its next equilibrium
  double heat = 0;          // J, ρ c_p (T − T₀) of metals; for information, not a term of the balance
  double external = 0;      // J, work of loads, prescribed motion and thermal expansion on the points so far
  double expansion = 0;     // J, of it, by thermal expansion
  double tool_kinetic = 0;  // J, of rigid tools with a mass
  double tools = 0;         // J, work of rigid tools on the points so far; energy that walls take is negative
  // J, work of contact between bodies on the points so far; energy that penalties store and friction takes is negative.
  double contact = 0;
  double gained = 0;                 // J, stored + dissipated − external work: numerical gain; a loss if negative
  double largest = 0;                // J, the largest sum of energies so far, at least the energy that round-off makes
  double balance_error = 0;          // |gained|/largest
  Vector momentum = Vector::Zero();  // kg m/s

  void take(const Energies& stored);
  // `largest_so_far`: of the ledgers before this one; energy_of_round_off() before the first.
  void balance(double held, double put_in, double& largest_so_far);
};

// Collective. Energy below which all may be round-off: that of a strain of 1e-12, J. Round-off of positions makes
// strains of some 1e-16 times their distance from the origin in spacings.
double energy_of_round_off(const Body& body);

// The work of the forces through periodic sides when their distance changes.

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
