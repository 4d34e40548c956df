#include "deck/sections/restart.hpp"

#include "deck/sections/when.hpp"

namespace strut::deck {

namespace {

const char* const name = "Restart";

const BooleanKey enabled({.name = "Enabled", .fallback = "true", .meaning = "False: none is written."});

const OptionalKey<std::string> file(
    {.name = "Filename",
     .meaning = "Relative to the working folder. Where it is not given: the deck's name with the "
                "suffix `.restart`. The one before stays beside it, as `.old`."});

const WhenKeys when;

const RealKey minutes({.name = "Minutes",
                       .unit = "min",
                       .range = positive,
                       .fallback = "30",
                       .meaning = "And every so many minutes of computing."});

const BooleanKey resumes(
    {.name = "Restart",
     .fallback = "false",
     .meaning = "Peridigm's. True: where there is a checkpoint already, a run that would begin "
                "anew and replace it is refused (`strut --continue deck.xml` goes on from it), and "
                "so is one without a checkpoint whose Initial Time is not 0."});

}  // namespace

Section restart_section() {
  return {.name = name,
          .meaning =
              "Checkpoints, from which `strut --continue deck.xml` resumes a run on any number of ranks. One is "
              "written at these times and when a signal ends the run. With this section one is also written at "
              "the end, so that the final time can be put off; without it, every " +
              *minutes.fallback + " minutes, and removed at the end.",
          .keys = {enabled, file, when.frequency, when.interval, minutes, resumes}};
}

Restart read_restart(const Values& deck, const std::filesystem::path& deck_file, Problems& problems) {
  const Values& values = deck.section(name);
  const std::filesystem::path of_deck = std::filesystem::path(deck_file.filename()).replace_extension(".restart");
  const auto given_file = values[file];
  Restart restart{.enabled = values[enabled],
                  .asked_for = deck.has_section(name),
                  .file = given_file ? std::filesystem::path(*given_file) : of_deck,
                  .resumes = values[resumes],
                  .minutes = values[minutes]};
  read_when(values, when, 0, restart, problems);
  return restart;
}

}  // namespace strut::deck
