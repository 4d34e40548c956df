// Inside mechanics: what the passes over the points of a block that end in their force states have in common.
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

struct StressPass {
  double dt;                 // s; of a step of the time-step level
  int level = 0;             // 0: a whole step
  bool of_any_size = false;  // the step may turn a point far; its rotation is found to round-off
  double time = 0;           // at the end of the step, s; for bonds that break
};

}  // namespace strut
