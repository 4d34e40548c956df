// Differences between a deck and the one with which a run began, and whether the run can continue with them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strut::deck {

struct Changes {
  std::vector<std::string>
      refused;                     // keys that make it another run, as "Materials > m > Density: 2000 before, 1000 now"
  std::vector<std::string> loads;  // loads that change from now on
  std::vector<std::string> accepted;  // times, steps, output, limits
};

// `before`, `now`: texts of decks without problems. Compares values, not their spelling; a missing key has its
// default.
Changes changes(const std::string& before, const std::string& now);

// How a deck that starts from the state of another run (Start From) differs from the deck of that run.
struct StartChanges {
  std::vector<std::string> refused;          // keys that make it another body, as above
  std::vector<std::filesystem::path> files;  // that the other run has written, seen from the folder of its checkpoint
  std::string masses;                        // another mass scaling, as above; "" if it is the same
  bool after_equilibria = false;             // the other run's solver
  bool same_solver = false, same_contact = false, same_conditions = false;
};
StartChanges start_changes(const std::string& other, const std::string& now);

}  // namespace strut::deck
