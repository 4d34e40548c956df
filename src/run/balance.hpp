// When points are spread over the ranks anew, and where each is to be: the ranks wait for the one with most work.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "deck/deck.hpp"
#include "setup/scene.hpp"

namespace strut {

// Work is counted (bonds, substeps, contact), not timed: what a run decides is the same when it is repeated or resumed.
class Balance {
 public:
  explicit Balance(const deck::Deck& deck);

  // Collective; between advance_position() and advance_velocity(). The rank where each owned point is to be, if it is
  // time to look, the work is uneven, and another partition will save more than it costs.
  std::optional<std::vector<int>> better_ranks(const Scene& scene, const CentralDifference& solver);

  // After a checkpoint has been read: the same, where it was written by as many ranks, with another partition.
  std::optional<std::vector<int>> take_restored_ranks() { return std::exchange(restored_, std::nullopt); }

  void serialize(Archive& archive, const Body& body);  // collective

 private:
  bool enabled_;
  double most_, final_time_;  // of the work of a rank beside the mean; s
  bool verbose_;
  double accepted_ = 0;  // the same, at the last look that found too much: no other until it is a tenth worse
  std::optional<std::vector<int>> restored_;
};

}  // namespace strut
