// Load balancing: when points are redistributed over the ranks, to which ranks, and how.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "base/errors.hpp"
#include "deck/deck.hpp"
#include "output/writers.hpp"
#include "setup/scene.hpp"

namespace strut {

// Work is counted (bonds, substeps, contact), not timed, so that a run decides the same when repeated or resumed.
class Balance {
 public:
  explicit Balance(const deck::Deck& deck);

  // Collective; between advance_position() and advance_velocity(). The rank for each owned point, if a check is due,
  // the work is uneven, and another partition will save more than it costs.
  std::optional<std::vector<int>> better_ranks(const Scene& scene, const CentralDifference& solver);

  // After a checkpoint has been read: the ranks of the points, if as many ranks wrote it with another partition.
  std::optional<std::vector<int>> take_restored_ranks() { return std::exchange(restored_, std::nullopt); }

  void serialize(Archive& archive, const Body& body);  // collective

 private:
  bool enabled_;
  double most_, final_time_;  // largest allowed work of a rank over the mean; s
  bool verbose_;
  // Largest work of a rank over the mean after the last decision; a new partition is considered at a tenth more.
  double accepted_ = 0;
  std::optional<std::vector<int>> restored_;
};

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
