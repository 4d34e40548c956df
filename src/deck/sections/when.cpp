#include "deck/sections/when.hpp"

namespace strut::deck {

namespace {

std::string without_either(int parts) {
  return parts > 0 ? " Default 1/" + std::to_string(parts) + " of the run." : "";
}

}  // namespace

WhenKeys::WhenKeys(const std::string& prefix, int parts_of_a_run)
    : frequency({.name = prefix + "Frequency",
                 .unit = "steps",
                 .range = {.low = 1},
                 .meaning = "Steps between two. Not together with " + prefix + "Interval."}),
      interval({.name = prefix + "Interval",
                .unit = "s",
                .range = positive,
                .meaning = "Simulated time between two." + without_either(parts_of_a_run)}),
      parts(parts_of_a_run) {}

}  // namespace strut::deck
