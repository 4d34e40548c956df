// The section History: numbers of the whole body in time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deck/forward.hpp"
#include "deck/sections/solver.hpp"

namespace strut::deck {

struct History {
  bool enabled = false;
  std::filesystem::path file;
  std::optional<int> frequency;
  std::optional<double> interval;
  std::vector<std::string> variables;  // e.g. "Max_Displacement"; checked by output_variables_of (output/variables.cpp)
};

Section history_section();
History read_history(const Values& deck, const Solver& solver, Problems& problems);

}  // namespace strut::deck
