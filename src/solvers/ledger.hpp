// The ledger of a run at one time.
#pragma once

#include "base/math/tensors.hpp"

namespace strut {

struct Ledger {
  double time = 0, dt = 0;                                             // s
  double kinetic = 0, elastic = 0, dissipated = 0, stabilization = 0;  // J
  double fracture = 0;                                                 // J, dissipated by bonds that broke
  double heat = 0;      // J, ρ c_p (T − T₀) of metals: no further term of the balance
  double external = 0;  // J, work of loads and prescribed motion on the points so far
  double tool_kinetic = 0;  // J, of rigid tools with a mass
  double tools = 0;     // J, work of rigid tools on the points so far: what walls take is negative
  // J, work of contact between bodies on the points so far: what penalties store and friction takes is negative.
  double contact = 0;
  double balance_error = 0;          // |stored + dissipated − put in| over the largest sum of energies so far
  Vector momentum = Vector::Zero();  // kg m/s
};

}  // namespace strut
