#include "deck/sections/restart.hpp"

#include "deck/sections/several_sections.hpp"

namespace strut::deck {

namespace {

const char* const name = "Restart";

const BooleanKey enabled({.name = "Enabled", .fallback = "true", .meaning = "false: no checkpoint is written."});

const OptionalKey<std::string> file({.name = "Filename",
                                     .meaning = "Path relative to the working folder. Default: the deck's name with "
                                                "the suffix `.restart`. The previous one is kept as `.old`."});

const WhenKeys when;

const RealKey minutes({.name = "Minutes",
                       .unit = "min",
                       .range = positive,
                       .fallback = "30",
                       .meaning = "Computing time between checkpoints, in addition."});

const BooleanKey resumes({.name = "Restart",
                          .fallback = "false",
                          .meaning = "Peridigm's key. true refuses a run that would replace a checkpoint, or that "
                                     "begins at another Initial Time than 0 without a checkpoint or Start From."});

const char* const start_name = "Start From";

const TextKey checkpoint({.name = "Checkpoint",
                          .meaning = "Path of the other run's checkpoint, relative to the working folder."});

const OptionalKey<bool> keeps_velocities(
    {.name = "Keep Velocities",
     .meaning =
         "true: points begin with the velocities of the checkpoint; false: at rest. Default: true after "
         "explicit steps, false after equilibria. An Initial Velocity replaces both, but kept velocities only where "
         "conditions differ."});

}  // namespace

Section restart_section() {
  return {.name = name,
          .meaning =
              "Checkpoints, from which `strut --continue deck.xml` resumes a run and another run can begin (Start "
              "From). They are written at these times, at a signal, and at the end; without this section every " +
              *minutes.fallback + " minutes, and at the end if there is a section Output or the run has gone on.",
          .keys = {enabled, file, when.frequency, when.interval, minutes, resumes}};
}

Restart read_restart(const Values& deck, const std::filesystem::path& deck_file, bool has_output, Problems& problems) {
  const Values& values = deck.section(name);
  const std::filesystem::path of_deck = std::filesystem::path(deck_file.filename()).replace_extension(".restart");
  const auto given_file = values[file];
  Restart restart{.enabled = values[enabled],
                  .asked_for = deck.has_section(name),
                  .kept_at_end = deck.has_section(name) || has_output,
                  .file = given_file ? std::filesystem::path(*given_file) : of_deck,
                  .resumes = values[resumes],
                  .minutes = values[minutes]};
  read_when(values, when, restart, problems);
  return restart;
}

Section start_from_section() {
  return {.name = start_name,
          .meaning =
              "Bodies begin as another run of the same mesh, blocks, materials, symmetry planes and periodic sides "
              "left them, on any number of ranks: positions, velocities, stress and state of the laws, temperature, "
              "thermal strain, broken bonds, friction of surfaces. Conditions, contact, solver and output are those of "
              "this deck; work begins at zero.",
          .keys = {checkpoint, keeps_velocities}};
}

std::optional<StartFrom> read_start_from(const Values& deck) {
  if (!deck.has_section(start_name)) return std::nullopt;
  const Values& values = deck.section(start_name);
  return StartFrom{.checkpoint = values[checkpoint], .keeps_velocities = values[keeps_velocities]};
}

}  // namespace strut::deck
