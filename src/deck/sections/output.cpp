#include "deck/sections/output.hpp"

#include "deck/sections/several_sections.hpp"

namespace strut::deck {

namespace {

const char* const name = "Output";

const Key file_type = {.name = "Output File Type",
                       .kind = Kind::choice,
                       .choices = {"ExodusII"},
                       .fallback = "ExodusII",
                       .meaning = "The format."};

const TextKey file({.name = "Output Filename",
                    .meaning = "Path relative to the working folder; `.e` is appended to a name without suffix."});

const WhenKeys when("Output ", 20);

const AnyKey<bool> variable("A field of inputs/VARIABLES.md, e.g. `Displacement`.");
const Section variables = {.name = "Output Variables", .meaning = "Fields to write.", .any_key = variable};

}  // namespace

Section output_section() {
  return {.name = name,
          .meaning = "Fields of the points in time; none without this section.",
          .keys = {file_type, file, when.frequency, when.interval,
                   without_effect({.name = "Output Format", .kind = Kind::text, .fallback = "BINARY"},
                                  "an Exodus file is binary"),
                   without_effect({.name = "Parallel Write", .kind = Kind::boolean, .fallback = "true"},
                                  "all ranks write one file")},
          .sections = {variables}};
}

Output read_output(const Values& deck, const Solver& solver, Problems& problems) {
  const Values* values = deck.find_section(name);
  if (!values) return {};
  Output output{
      .enabled = true, .file = (*values)[file], .variables = switched_on(values->section(variables.name), variable)};
  if (!output.file.has_extension()) output.file += ".e";
  read_when(*values, when, solver.duration(), output, problems);
  return output;
}

}  // namespace strut::deck
