// When something is written: every so many steps, or every so much time.
#pragma once

#include <string>

#include "deck/sections/two_keys.hpp"

namespace strut::deck {

struct WhenKeys {
  OptionalKey<int> frequency;
  OptionalKey<double> interval;

  // "Output Frequency", "Output Interval". Without both, an interval: so many to a run, where that is not 0.
  explicit WhenKeys(const std::string& prefix = "", int parts_of_a_run = 0);

  int parts;
};

// Into the members of these names. `duration`: of the run, in s.
template <class Sink>
void read_when(const Values& values, const WhenKeys& keys, double duration, Sink& sink, Problems& problems) {
  check_one_of(values, keys.frequency, keys.interval, problems);
  sink.frequency = values[keys.frequency];
  if (!sink.frequency) sink.interval = values[keys.interval];
  if (!sink.frequency && !sink.interval && keys.parts > 0) sink.interval = 1.0 / keys.parts * duration;
}

}  // namespace strut::deck
