// The section Output: the fields of the points over time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deck/forward.hpp"
#include "deck/sections/solver.hpp"

namespace strut::deck {

struct Output {
  bool enabled = false;
  std::filesystem::path file;          // relative to the working folder in the deck, ".e" appended if it has no suffix
  std::optional<int> frequency;        // every so many steps
  std::optional<double> interval;      // or every so many seconds of the simulation
  int parts = 0;                       // of the solver's time, if the deck gives neither
  std::vector<std::string> variables;  // checked by output_variables_of (output/variables.cpp)
};

Section output_section();
Output read_output(const Values& deck, const Solver& solver, Problems& problems);

}  // namespace strut::deck
