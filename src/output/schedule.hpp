// When output is due: every so many steps, or at a time interval of the simulation (s).
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "base/archive.hpp"

namespace strut {

constexpr double never = -std::numeric_limits<double>::infinity();

class Schedule {
 public:
  Schedule(bool enabled, std::optional<int> frequency, std::optional<double> interval, double initial_time);

  bool is_scheduled(int step, double time) const;
  // `step`, `time`: of the archive. A restored schedule with another interval or frequency starts anew there. Output
  // that was due there by the former one stays due: it comes after the archive. While a run goes on without this
  // output, that of its first time is remembered.
  void serialize(Archive& archive, const std::string& name, int step, double time);

  // Where a run without this output has begun, s, if this one has it again: the file may have that time beyond what was
  // counted for the archive.
  std::optional<double> uncounted() const { return uncounted_; }

  void done(double time);  // the next time is the first multiple of the interval after `time`

 private:
  bool enabled_;
  std::optional<int> frequency_;
  std::optional<double> interval_;
  double initial_time_, next_time_;
  double pending_at_ = never;  // s, a time of the former schedule at which output is still to be written
  std::optional<double> uncounted_;
};

}  // namespace strut
