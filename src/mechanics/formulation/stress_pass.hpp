// Inside mechanics: the passes over a block's points by each formulation, from their positions to their force states.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "mechanics/kernels/lane_groups.hpp"
#include "mechanics/step_report.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

// The worst failure in a loop over the points of a block; between equal kinds the first point, for any thread count.
class WorstFailure {
 public:
  void report(int k, Failure::Kind kind) {
    const std::int64_t code = (static_cast<std::int64_t>(kind) << 32) + k;
    std::int64_t worst = code_;
    while (code < worst && !code_.compare_exchange_weak(worst, code)) {
    }
  }
  std::optional<Failure> found(const MaterialBlock& block) const {
    const std::int64_t code = code_;
    if (code == none) return std::nullopt;
    return Failure{block.points[static_cast<std::uint32_t>(code)], static_cast<Failure::Kind>(code >> 32)};
  }

 private:
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::atomic<std::int64_t> code_ = none;
};

struct StressPass {
  double dt;                 // s; of a step of the time-step level
  int level = 0;             // 0: a whole step
  bool of_any_size = false;  // the step may rotate a point far; its rotation is found to round-off
  double time = 0;           // at the end of the step, s; for bonds that break and points that expand
};

// ---- Correspondence ----

void advance_stress(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                    StepReport& report);

// Sets the residuals Σ ω V |y_j − y_i − F ξ|² (m⁵) of the least-squares fit of F; on a lattice, from sums of squares.
void diagnose_residuals(Body& body, const LaneGroups& groups);

// Adds the springs on the residual of both ends' gradients to a point: their force, and what they take from A through
// F, ½ M K⁻¹. `own_force`: the force that the point's own state gives.
inline void add_residual(const Vector& force, const Tensor& moment, const Symmetric& shape_inverse,
                         const Vector& first_moment, ForceState& state, Vector& own_force) {
  const Tensor taken = 0.5 * moment * to_tensor(shape_inverse);
  for (int c = 0; c < 3; ++c) state.column[c].head<3>() -= taken.col(c).array();
  own_force += force - taken * first_moment;
}

// ---- Ordinary solids ----

void advance_ordinary(Body& body, MaterialBlock& block, bool with_diagnostics, const LaneGroups& groups,
                      StepReport& report);

// The force state of an ordinary point with dilatation θ and weighted volume m (m⁵).
inline ScalarState scalar_state(const materials::Moduli& moduli, double dilatation, double weighted_volume) {
  return {(3 * moduli.bulk - 5 * moduli.shear) * dilatation / weighted_volume, 15 * moduli.shear / weighted_volume};
}

// ---- Quadratic correspondence ----

void advance_quadratic(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                       StepReport& report);

// Sets F, R and stress of each point, for output, from those of its cell.
void diagnose_cells(Body& body, const MaterialBlock& block, const LaneGroups& groups);

}  // namespace strut
