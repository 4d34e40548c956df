// The critical time step of central differences in the current state, 2/ω_max: the largest stable one.
#pragma once

#include "base/archive.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

// Restarted Lanczos iteration on the linearized operator M⁻¹K (mechanics: apply_tangent). Ritz values approach ω²_max
// from below; the residual of the last one is added, so that the estimate errs on the safe side.
class CriticalTimeStep {
 public:
  // Collective. 2/ω_max in s, the same on any number of ranks to the last bit; infinity for a body without stiffness.
  // Later calls start from the mode found last, which makes them cheaper. Spoils body.force_states, which are of use
  // only between stresses and forces.
  double estimate(Body& body);

  void serialize(Archive& archive, const Body& body);  // at the group of all owned points

  // Bytes that an estimate takes on this rank while it runs.
  static double bytes(const Body& body);

  static constexpr int basis_size = 8;      // vectors kept: 12 bytes a point each while the estimate runs
  static constexpr int most_cycles = 8;     // of basis_size products each
  static constexpr double accuracy = 0.02;  // of ω²_max: 1 % of the step

 private:
  bool found_ = false;                 // on all ranks: those without points have none, too
  std::vector<Eigen::Vector3f> mode_;  // the mode found last, of length 1
};

}  // namespace strut
