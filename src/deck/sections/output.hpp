// The sections Output, the fields of the points over time, and History, totals of the body.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/math/tensors.hpp"
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

// A crack that the history tracks: the points whose damage exceeds a limit.
struct WatchedCrack {
  std::string name;
  Vector direction = Vector::UnitX();  // of length 1
  Vector start = Vector::Zero();       // m
  double damage = 0;
  std::string node_set = "all";  // or a block
  int rows = 0;                  // of the history, used for its speed
};

// Layers of the body across a direction, of equal thickness in the reference state.
struct Profile {
  std::string name;
  Vector direction = Vector::UnitZ();  // of length 1
  int layers = 0;
  std::string node_set = "all";  // or a block
};

struct History {
  bool enabled = false;
  std::filesystem::path file;  // empty: its rows stay in memory
  std::optional<int> frequency;
  std::optional<double> interval;
  int parts = 0;                       // of the solver's time, if the deck gives neither
  std::vector<std::string> variables;  // e.g. "Max_Displacement"; checked by output_variables_of (output/variables.cpp)
  std::vector<WatchedCrack> cracks;
  std::vector<Profile> profiles;

  bool has_file() const { return enabled && !file.empty(); }
};

struct NodeSet;

Section history_section();
// Its probes, as node sets.
void add_probes(const Values& deck, std::vector<NodeSet>& sets);
History read_history(const Values& deck, const Solver& solver, Problems& problems);

}  // namespace strut::deck
