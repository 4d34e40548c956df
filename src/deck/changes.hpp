// What a deck says otherwise than the one with which a run began, and whether the run can go on so.
#pragma once

#include <string>
#include <vector>

namespace strut::deck {

struct Changes {
  std::vector<std::string>
      refused;                     // keys that make another run of it: "Materials > m > Density: 2000 before, 1000 now"
  std::vector<std::string> loads;  // loads that are others from now on
  std::vector<std::string> accepted;  // times, steps, output, limits
};

// `before`, `now`: the texts of decks without problems. Values are compared, not how they are written; what a deck
// leaves to its default is that.
Changes changes(const std::string& before, const std::string& now);

}  // namespace strut::deck
