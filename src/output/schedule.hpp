// When output is due: every so many steps, or at a time interval of the simulation (s).
#pragma once

#include <optional>
#include <string>

#include "base/archive.hpp"

namespace strut {

class Schedule {
 public:
  Schedule(bool enabled, std::optional<int> frequency, std::optional<double> interval, double initial_time);

  bool due(int step, double time) const;
  // `time`: of the archive. A restored schedule with another interval starts anew there.
  void serialize(Archive& archive, const std::string& name, double time);

  void done(double time);  // the next time is the first multiple of the interval after `time`

 private:
  bool enabled_;
  std::optional<int> frequency_;
  std::optional<double> interval_;
  double initial_time_, next_time_;
};

}  // namespace strut
