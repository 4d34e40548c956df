// Input and result of the methods that find an equilibrium.
#pragma once

#include <functional>
#include <string>

#include "integrators/quasi_static/equilibrium.hpp"

namespace strut {

// Callbacks of an equilibrium search.
struct Observer {
  std::function<void(const std::string&)> load_steps;  // called with a line for each load step, on rank 0
  std::function<void(const std::string&)> iterations;  // called with a line for each iteration; may be empty
  std::function<bool()> stop_requested;                // true if the run must end: on any rank, at any time
};

struct EquilibriumSearch {
  bool converged = false;
  int iterations = 0;
  int evaluations = 0;  // of the forces, or of the tangent times a field
  Imbalance left;
  bool interrupted = false;
  int rounds = 1;  // of the multipliers of tools
};

}  // namespace strut
