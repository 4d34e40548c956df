// Inside mechanics: the pass over the points of a block that ends in their force states.
#pragma once

#include <cstdint>
#include <limits>

#include "mechanics/kernels/lane_groups.hpp"
#include "mechanics/step_report.hpp"
#include "points/parallel_for.hpp"

namespace strut {

// The worst failure of a loop over the points of a block, the first of these in their order, whichever thread finds it.
class WorstFailure {
 public:
  void report(int k, Failure::Kind kind) {
    Kokkos::atomic_fetch_min(&code_, (static_cast<std::int64_t>(kind) << 32) + k);
  }
  std::optional<Failure> found(const MaterialBlock& block) const {
    if (code_ == none) return std::nullopt;
    return Failure{block.points[static_cast<std::uint32_t>(code_)], static_cast<Failure::Kind>(code_ >> 32)};
  }

 private:
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::int64_t code_ = none;
};

// Of a block by correspondence (stress.cpp), by quadratic correspondence (quadratic_stress.cpp), and of an ordinary one
// (ordinary.cpp).
//   dt: of a step that is halved `order` times
//   of_any_size: the step may turn a point far; its rotation is found to round-off
struct StressPass {
  double dt;
  int order = 0;
  bool of_any_size = false;
};
void advance_stress(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                    StepReport& report);
void advance_quadratic(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                       StepReport& report);
void advance_ordinary(Body& body, MaterialBlock& block, bool with_diagnostics, const LaneGroups& groups,
                      StepReport& report);

// By quadratic correspondence: F and R of each point, and its stress, from those of its cell.
void diagnose_cells(Body& body, const MaterialBlock& block, const LaneGroups& groups);

// The largest damping by viscosity of the points of a whole step.
void add_damping(const MaterialBlock& block, const StressPass& pass, const LaneGroups& groups, StepReport& report);

// Σ ω V |y_j − y_i − F ξ|², the least-squares residual of F; on a lattice from its squares.
void diagnose_residuals(Body& body, const LaneGroups& groups);

// Adds the springs on the residual of both ends' gradients to a point: their force, and what they take from A by way of
// F, ½ M K⁻¹. `own_force`: what the point's own state gives to the force on it.
inline void add_residual(const Vector& force, const Tensor& moment, const Symmetric& shape_inverse,
                         const Vector& first_moment, ForceState& state, Vector& own_force) {
  const Tensor taken = 0.5 * moment * to_tensor(shape_inverse);
  for (int c = 0; c < 3; ++c) state.column[c].head<3>() -= taken.col(c).array();
  own_force += force - taken * first_moment;
}

// The state of the bonds of an ordinary point of dilatation θ and weighted volume m.
inline ScalarState scalar_state(const materials::Moduli& moduli, double dilatation, double weighted_volume) {
  return {(3 * moduli.bulk - 5 * moduli.shear) * dilatation / weighted_volume, 15 * moduli.shear / weighted_volume};
}

}  // namespace strut
