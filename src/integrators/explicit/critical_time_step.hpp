// The critical time step of central differences in the current state, 2/ω_max.
#pragma once

#include "base/archive.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

// Restarted Lanczos iteration on the linearized operator M⁻¹K (mechanics: apply_tangent). Ritz values approach ω²_max
// from below; the residual of the last one is added, so that the estimate is on the safe side.
class CriticalTimeStep {
 public:
  // Collective. 2/ω_max in s, the same on any number of ranks to the last bit; infinity for a body without stiffness.
  // Later calls start from the mode found last, which makes them cheaper. Overwrites body.force_states: where bonds may
  // break, the next step needs them, and the caller keeps a copy (StepLength::estimate).
  double estimate(Body& body);

  void serialize(Archive& archive, const Body& body);  // call it at the group of all owned points

  // Memory that an estimate takes on this rank while it runs, bytes.
  static double bytes(const Body& body);

  static constexpr int basis_size = 8;      // stored vectors, each 12 bytes per point while the estimate runs
  static constexpr int most_cycles = 8;     // each of basis_size products
  static constexpr double accuracy = 0.02;  // relative, of ω²_max: 1 % of the step

 private:
  bool found_ = false;                 // the same on all ranks, also on those without points
  std::vector<Eigen::Vector3f> mode_;  // the mode found last, of length 1
};

}  // namespace strut
