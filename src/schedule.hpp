// When something is due: every so many steps, or every so many seconds of the simulation.
#pragma once

#include <optional>

namespace strut {

class Schedule {
 public:
  Schedule(bool enabled, std::optional<int> frequency, std::optional<double> interval, double initial_time);

  bool due(int step, double time) const;
  void done(double time);  // the next time is the first multiple of the interval after `time`

 private:
  bool enabled_;
  std::optional<int> frequency_;
  std::optional<double> interval_;
  double initial_time_, next_time_;
};

}  // namespace strut
