#include "deck/sections/history.hpp"

#include "deck/sections/tools.hpp"
#include "deck/sections/variables.hpp"
#include "deck/sections/when.hpp"

namespace strut::deck {

namespace {

const char* const name = "History";

const TextKey file({.name = "Filename", .meaning = "Relative to the working folder."});

const WhenKeys when("", 1000);

const AnyKey<bool> variable(
    "E.g. `Max_Displacement`, or `Max_Displacement(foam)` for a node set or block; "
    "`Mean_Velocity_Z(foam)`, or `Mean_Velocity_Z(slices)` for each layer of the section `slices` of Profiles; "
    "`Sum_Force_Z(foam)`, over all points of a set; "
    "`Contact_Force_Z(foam:plate)` for the force (N) of contact on the block `foam` from `plate`; "
    "`Reaction_Z(wall)` for the force (N) of the condition `wall` on the body, "
    "e.g. of prescribed motion, a symmetry plane or a rigid tool, both as means since the row before "
    "(`Instant_Reaction_Z(wall)`: of one step); "
    "`Crack_Tip(notch)` (m) and `Crack_Speed(notch)` (m/s) of the crack `notch` in Cracks.");
const Section variables = {.name = "Variables", .meaning = "The columns.", .any_key = variable};

const VectorKey direction({.name = "Direction",
                           .fallback = "1 0 0",
                           .meaning = "In which the crack grows, of any length but zero."});
const VectorKey start({.name = "Start",
                       .unit = "m",
                       .fallback = "0 0 0",
                       .meaning = "From where its way is measured, as the tip of a notch."});
const RealKey damage(
    {.name = "Damage",
     .range = {.low = 0, .high = 1},
     .fallback = "0.35",
     .meaning = "A point is cracked where its Damage is above this. Beside a flat crack it is near 0.4."});
const TextKey node_set({.name = "Node Set",
                        .fallback = "all",
                        .meaning = "Points elsewhere do not count: a node set, a block, or `all`."});
const IntegerKey rows(
    {.name = "Rows",
     .range = {.low = 2, .high = 1000},
     .fallback = "7",
     .meaning = "Of how many rows of the history the speed is taken: a tip goes from point to point."});
const Section cracks = {.name = "Cracks",
                        .meaning =
                            "Cracks whose tips are followed: of the cracked points the one that is farthest from the "
                            "start along the direction, in the reference state. 0 where none is beyond the start.",
                        .sections = {{.name = any_name,
                                      .required = true,
                                      .meaning = "One crack.",
                                      .keys = {direction, start, damage, node_set, rows}}}};

const VectorKey across({.name = "Direction",
                        .fallback = "0 0 1",
                        .meaning = "Across the layers, of any length but zero."});
const IntegerKey layers({.name = "Layers",
                         .range = {.low = 1, .high = 10000},
                         .meaning = "How many; each holds a point."});
const Section profiles = {
    .name = "Profiles",
    .meaning =
        "Layers of equal thickness in the reference state, of which the history has means: of "
        "`Mean_Velocity_Z(slices)` the columns `Mean_Velocity_Z(slices 1)`, `Mean_Velocity_Z(slices 2)`, ….",
    .sections = {
        {.name = any_name, .required = true, .meaning = "One set of layers.", .keys = {across, layers, node_set}}}};

Profile read_profile(const Values& values, Problems& problems) {
  return {values.name(), read_direction(values, across, problems), values[layers], values[node_set]};
}

WatchedCrack read_crack(const Values& values, Problems& problems) {
  const Vector along = read_direction(values, direction, problems);
  return {values.name(), along, values[start], values[damage], values[node_set], values[rows]};
}

}  // namespace

Section history_section() {
  return {.name = name,
          .meaning = "Numbers of the whole body in time, as a table (CSV). Without this section there is none.",
          .keys = {file, when.frequency, when.interval},
          .sections = {variables, cracks, profiles}};
}

History read_history(const Values& deck, const Solver& solver, Problems& problems) {
  const Values* values = deck.find_section(name);
  if (!values) return {};
  History history{
      .enabled = true, .file = (*values)[file], .variables = switched_on(values->section(variables.name), variable)};
  for (const Values& one : values->section(cracks.name).sections()) history.cracks.push_back(read_crack(one, problems));
  for (const Values& one : values->section(profiles.name).sections())
    history.profiles.push_back(read_profile(one, problems));
  read_when(*values, when, solver.duration(), history, problems);
  return history;
}

}  // namespace strut::deck
