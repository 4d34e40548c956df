// Changes the partition of an explicit run in memory.
#pragma once

#include <optional>
#include <vector>

#include "base/errors.hpp"
#include "deck/deck.hpp"
#include "output/writers.hpp"
#include "setup/scene.hpp"

namespace strut {

// The objects that depend on the partition.
struct ExplicitRun {
  const deck::Deck& deck;
  std::optional<Scene>& scene;
  std::optional<CentralDifference>& solver;
  std::optional<OutputWriters>& writers;
};

// Thrown if a change fails halfway, when there is neither the old run nor the new one.
struct LostState : Error {
  using Error::Error;
};

// Collective; between advance_position() and advance_velocity(). Rebuilds all objects in place, with each owned point
// on the rank given for it, and restores their state as from a checkpoint.
void repartition(const ExplicitRun& run, const std::vector<int>& ranks);

}  // namespace strut
