// When something is written: every so many steps, or at a time interval.
#pragma once

#include <string>

#include "deck/sections/two_keys.hpp"

namespace strut::deck {

struct WhenKeys {
  OptionalKey<int> frequency;
  OptionalKey<double> interval;

  // "Output Frequency", "Output Interval". Without both: an interval with `parts_of_a_run` per run, if that is not 0.
  explicit WhenKeys(const std::string& prefix = "", int parts_of_a_run = 0);

  int parts;
};

// Reads into members with these names. `duration`: of the run, s.
template <class Sink>
void read_when(const Values& values, const WhenKeys& keys, double duration, Sink& sink, Problems& problems) {
  check_one_of(values, keys.frequency, keys.interval, problems);
  sink.frequency = values[keys.frequency];
  if (!sink.frequency) sink.interval = values[keys.interval];
  if (!sink.frequency && !sink.interval && keys.parts > 0) sink.interval = 1.0 / keys.parts * duration;
}

}  // namespace strut::deck
