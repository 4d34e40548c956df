// Keys and checks that several sections share.
#pragma once

#include <string>
#include <vector>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"

namespace strut::deck {

// Reports if both keys are given.
void check_one_of(const Values& values, const Key& one, const Key& other, Problems& problems);

// True if exactly one of them is given; else reports it.
bool check_exactly_one(const Values& values, const Key& one, const Key& other, Problems& problems);

// The index of `wanted`, the value of `key`, in `names`, the sections of `where`; the number of names if there is
// none.
int find_name(const Values& section, const Key& key, const std::string& wanted, const std::vector<std::string>& names,
              const std::string& where, Problems& problems);

template <class Named>
int find_named(const Values& section, const Key& key, const std::string& wanted, const std::vector<Named>& all,
               const std::string& where, Problems& problems) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return find_name(section, key, wanted, names, where, problems);
}

template <class Named>
int find_named(const Values& section, const TextKey& key, const std::vector<Named>& all, const std::string& where,
               Problems& problems) {
  return find_named(section, key, section[key], all, where, problems);
}

// When something is written: every so many steps, or at a time interval.
struct WhenKeys {
  OptionalKey<int> frequency;
  OptionalKey<double> interval;

  // "Output Frequency", "Output Interval". Without both: an interval with `parts_of_a_solver` in the time of each
  // solver, if that is not 0.
  explicit WhenKeys(const std::string& prefix = "", int parts_of_a_solver = 0);

  int parts;
};

// Reads into members with these names.
template <class Sink>
void read_when(const Values& values, const WhenKeys& keys, Sink& sink, Problems& problems) {
  check_one_of(values, keys.frequency, keys.interval, problems);
  sink.frequency = values[keys.frequency];
  if (!sink.frequency) sink.interval = values[keys.interval];
}

// The same where there is a default, a part of the solver's time. `duration`: of that, s.
template <class Sink>
void take_default_interval(double duration, Sink& sink) {
  if (sink.parts > 0) sink.interval = 1.0 / sink.parts * duration;
}
template <class Sink>
void read_when(const Values& values, const WhenKeys& keys, double duration, Sink& sink, Problems& problems) {
  read_when(values, keys, sink, problems);
  if (!sink.frequency && !sink.interval) sink.parts = keys.parts;
  take_default_interval(duration, sink);
}

// Lists of output variables, whose keys are names of variables.
inline std::vector<std::string> switched_on(const Values& variables, const AnyKey<bool>& variable) {
  std::vector<std::string> names;
  for (const auto& [name, on] : variables.all(variable)) {
    if (on) names.push_back(name);
  }
  return names;
}

// A key of Peridigm's decks that has no effect here; it exists because users of Peridigm will try it.
Key without_effect(Key key, const std::string& why);

Key verbose_without_effect();

}  // namespace strut::deck
