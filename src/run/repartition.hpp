// An explicit run on another partition, in memory.
#pragma once

#include <optional>
#include <vector>

#include "base/errors.hpp"
#include "deck/deck.hpp"
#include "output/writers.hpp"
#include "setup/scene.hpp"

namespace strut {

// What depends on where points are.
struct ExplicitRun {
  const deck::Deck& deck;
  std::optional<Scene>& scene;
  std::optional<CentralDifference>& solver;
  std::optional<OutputWriters>& writers;
};

// Thrown in the middle of a change, when there is neither the old run nor the new one.
struct LostState : Error {
  using Error::Error;
};

// Collective; between advance_position() and advance_velocity(). Makes all of it anew where it stands, with each owned
// point on the rank that is named for it, and gives it back what it held, as from a checkpoint.
void repartition(const ExplicitRun& run, const std::vector<int>& ranks);

}  // namespace strut
