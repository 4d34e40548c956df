#include "deck/sections/history.hpp"

#include "deck/sections/variables.hpp"
#include "deck/sections/when.hpp"

namespace strut::deck {

namespace {

const char* const name = "History";

const TextKey file({.name = "Filename", .meaning = "Relative to the working folder."});

const WhenKeys when("", 1000);

const AnyKey<bool> variable(
    "E.g. `Max_Displacement`, or `Max_Displacement(foam)` for a node set or block; "
    "`Reaction_Z(wall)` for the force (N) of the condition `wall` on the body, "
    "e.g. of prescribed motion, a symmetry plane or a rigid tool.");
const Section variables = {.name = "Variables", .meaning = "The columns.", .any_key = variable};

}  // namespace

Section history_section() {
  return {.name = name,
          .meaning = "Numbers of the whole body in time, as a table (CSV). Without this section there is none.",
          .keys = {file, when.frequency, when.interval},
          .sections = {variables}};
}

History read_history(const Values& deck, const Solver& solver, Problems& problems) {
  const Values* values = deck.find_section(name);
  if (!values) return {};
  History history{
      .enabled = true, .file = (*values)[file], .variables = switched_on(values->section(variables.name), variable)};
  read_when(*values, when, solver.duration(), history, problems);
  return history;
}

}  // namespace strut::deck
