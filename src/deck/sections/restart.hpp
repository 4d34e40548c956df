// The section Restart: checkpoints from which a run can be resumed.
#pragma once

#include <filesystem>
#include <optional>

#include "deck/forward.hpp"

namespace strut::deck {

struct Restart {
  bool enabled{};
  bool asked_for = false;          // the deck has the section: the file is kept at the end of the run
  std::filesystem::path file;      // relative to the working folder; the deck's name with the suffix .restart
  std::optional<int> frequency;    // every so many steps
  std::optional<double> interval;  // or every so many seconds of the simulation
  bool resumes = false;            // the deck itself asks to resume from the file, if there is one
  double minutes{};                // and every so many minutes of wall time
};

Section restart_section();
Restart read_restart(const Values& deck, const std::filesystem::path& deck_file, Problems& problems);

}  // namespace strut::deck
