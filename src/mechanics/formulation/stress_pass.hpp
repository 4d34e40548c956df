// Inside mechanics: shared by the passes over a block's points that set their force states.
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

}  // namespace strut
