#include "deck/sections/output.hpp"

#include "deck/sections/node_sets.hpp"
#include "deck/sections/several_sections.hpp"
#include "deck/sections/tools.hpp"

namespace strut::deck {

namespace {

const char* const output_name = "Output";

const Key file_type = {.name = "Output File Type",
                       .kind = Kind::choice,
                       .choices = {"ExodusII"},
                       .fallback = "ExodusII",
                       .meaning = "The format."};

const TextKey output_file(
    {.name = "Output Filename",
     .meaning = "Path relative to the working folder; `.e` is appended to a name without suffix."});

const WhenKeys output_when("Output ", 20);

const AnyKey<bool> field("A field of inputs/VARIABLES.md, e.g. `Displacement`.");
const Section fields = {.name = "Output Variables", .meaning = "Fields to write.", .any_key = field};

// ---- History

const char* const name = "History";

const OptionalKey<std::string> file(
    {.name = "Filename", .meaning = "Relative to the working folder. Required, but not of a script in Python."});

const WhenKeys when("", 1000);

const AnyKey<bool> variable(
    "E.g. `Max_Displacement(foam)`, `Displacement_Z(tip)` of a probe, `Sum_Force_Z(foam)`, `Mean_Velocity_Z(slices)`, "
    "`Contact_Force_Z(foam:plate)`, "
    "`Reaction_Z(wall)`, "
    "`Crack_Tip(notch)`: see inputs/VARIABLES.md.");
const Section variables = {.name = "Variables", .meaning = "Columns.", .any_key = variable};

const VectorKey direction({.name = "Direction", .fallback = "1 0 0", .meaning = "Direction of growth, of any length."});
const VectorKey start(
    {.name = "Start", .unit = "m", .fallback = "0 0 0", .meaning = "Origin of the length, e.g. the tip of a notch."});
const RealKey damage(
    {.name = "Damage",
     .range = {.low = 0, .high = 1},
     .fallback = "0.35",
     .meaning = "A point is cracked where its Damage exceeds this; beside a flat crack Damage is near 0.4."});
const TextKey node_set({.name = "Node Set",
                        .fallback = "all",
                        .meaning = "A node set, a block, or `all`: other points do not count."});
const IntegerKey rows({.name = "Rows",
                       .range = {.low = 2, .high = 1000},
                       .fallback = "7",
                       .meaning = "Number of rows over which the speed is fitted."});
const Section cracks = {.name = "Cracks",
                        .meaning =
                            "Cracks whose tips are followed. The tip is the cracked point farthest from the start "
                            "along the direction, in the reference state; 0 if no point is cracked.",
                        .sections = {{.name = any_name,
                                      .required = true,
                                      .meaning = "One crack.",
                                      .keys = {direction, start, damage, node_set, rows}}}};

const VectorKey across({.name = "Direction", .fallback = "0 0 1", .meaning = "Normal of the layers, of any length."});
const IntegerKey layers({.name = "Layers",
                         .range = {.low = 1, .high = 10000},
                         .meaning = "Number of layers; each holds a point."});
const Section profiles = {
    .name = "Profiles",
    .meaning =
        "Layers of equal thickness in the reference state. `Mean_Velocity_Z(slices)` makes the columns "
        "`Mean_Velocity_Z(slices 1)`, `Mean_Velocity_Z(slices 2)`, ….",
    .sections = {
        {.name = any_name, .required = true, .meaning = "One set of layers.", .keys = {across, layers, node_set}}}};

const VectorKey place({.name = "Point", .unit = "m", .meaning = "Position in the reference state."});
const Section probes = {.name = "Probes",
                        .meaning =
                            "Positions whose nearest points the history follows, as `Displacement_Z(tip)`: each is a "
                            "node set of one point, whose position the run prints at its start.",
                        .sections = {{.name = any_name, .required = true, .meaning = "One probe.", .keys = {place}}}};

Profile read_profile(const Values& values, Problems& problems) {
  return {values.name(), read_direction(values, across, problems), values[layers], values[node_set]};
}

WatchedCrack read_crack(const Values& values, Problems& problems) {
  const Vector along = read_direction(values, direction, problems);
  return {values.name(), along, values[start], values[damage], values[node_set], values[rows]};
}

}  // namespace

Section output_section() {
  return {.name = output_name,
          .meaning = "Fields of the points in time; none without this section.",
          .keys = {file_type, output_file, output_when.frequency, output_when.interval,
                   without_effect({.name = "Output Format", .kind = Kind::text, .fallback = "BINARY"},
                                  "an Exodus file is binary"),
                   without_effect({.name = "Parallel Write", .kind = Kind::boolean, .fallback = "true"},
                                  "all ranks write one file")},
          .sections = {fields}};
}

Output read_output(const Values& deck, const Solver& solver, Problems& problems) {
  const Values* values = deck.find_section(output_name);
  if (!values) return {};
  Output output{
      .enabled = true, .file = (*values)[output_file], .variables = switched_on(values->section(fields.name), field)};
  if (!output.file.has_extension()) output.file += ".e";
  read_when(*values, output_when, solver.duration(), output, problems);
  return output;
}

Section history_section() {
  return {.name = name,
          .meaning = "Numbers in time as a table (CSV); none without this section.",
          .keys = {file, when.frequency, when.interval},
          .sections = {variables, cracks, profiles, probes}};
}

void add_probes(const Values& deck, std::vector<NodeSet>& sets) {
  if (!deck.has_section(name)) return;
  for (const Values& one : deck.section(name).section(probes.name).sections())
    sets.push_back({.name = one.name(), .where = Function(), .nearest = one[place]});
}

History read_history(const Values& deck, const Solver& solver, Problems& problems) {
  if (!deck.has_section(name)) return {};
  const Values& values = deck.section(name);
  History history{.enabled = true,
                  .file = values[file].value_or(""),
                  .variables = switched_on(values.section(variables.name), variable)};
  for (const Values& one : values.section(cracks.name).sections()) history.cracks.push_back(read_crack(one, problems));
  for (const Values& one : values.section(profiles.name).sections())
    history.profiles.push_back(read_profile(one, problems));
  for (const Values& one : values.section(probes.name).sections()) {
    if (one.name() == "all") problems.add(one.path(), "is the set of all points; expected another name");
  }
  read_when(values, when, solver.duration(), history, problems);
  return history;
}

}  // namespace strut::deck
