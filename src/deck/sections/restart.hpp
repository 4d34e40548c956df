// The sections Restart, checkpoints from which a run can be resumed, and Start From, the state in which another run has
// ended.
#pragma once

#include <filesystem>
#include <optional>

#include "deck/forward.hpp"

namespace strut::deck {

struct Restart {
  bool enabled{};
  bool asked_for = false;          // the deck has the section
  bool kept_at_end = false;        // a finished run keeps the file
  std::filesystem::path file;      // relative to the working folder; the deck's name with the suffix .restart
  std::optional<int> frequency;    // every so many steps
  std::optional<double> interval;  // or every so many seconds of the simulation
  bool resumes = false;            // the deck itself asks to resume from the file, if there is one
  double minutes{};                // and every so many minutes of wall time
};

Section restart_section();
// `has_output`: the run writes frames; it keeps the state of the last one.
Restart read_restart(const Values& deck, const std::filesystem::path& deck_file, bool has_output, Problems& problems);

struct StartFrom {
  std::filesystem::path checkpoint;      // relative to the working folder
  std::optional<bool> keeps_velocities;  // nullopt: after explicit steps, not after equilibria
};

Section start_from_section();
std::optional<StartFrom> read_start_from(const Values& deck);  // nullopt without the section

}  // namespace strut::deck
