// The forces of conditions on the points of the body, for whoever asks: gathered by a solver of any kind, read by the
// history.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "base/math/tensors.hpp"

namespace strut {

// The reaction place of conditions that have no reaction.
constexpr int no_reaction = -1;

// Of all conditions at one time. N, over all ranks, by the condition's place in the deck; zero for those that have no
// reaction. Empty where nobody asked for reactions.
struct Reactions {
  std::vector<Vector> forces;
};

// What acts at a time of explicit steps, on this rank: forces do for so long before it and after it, s; the impulses of
// conditions, N s, by the condition's place in the deck, those since the time before included. Empty where nobody
// asked.
struct StepImpulses {
  double before = 0, after = 0;
  std::vector<Vector> conditions_before, conditions_after;
};

// The impulses of conditions on the points of this rank, N s, by the condition's place in the deck: over the time that
// they stand for, these are reactions. Made for no conditions, it gathers nothing.
class ReactionImpulses {
 public:
  explicit ReactionImpulses(int conditions = 0) : sums_(conditions, Vector::Zero()) {}

  void add(int reaction_place, const Vector& impulse) {
    if (static_cast<std::size_t>(reaction_place) < sums_.size()) sums_[reaction_place] += impulse;  // not no_reaction
  }
  const std::vector<Vector>& sums() const { return sums_; }

  void serialize(Archive& archive) {
    for (std::size_t c = 0; c < sums_.size(); ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        archive.share("impulse_" + std::to_string(c) + "xyz"[axis], sums_[c][axis]);
      }
    }
  }

 private:
  std::vector<Vector> sums_;
};

}  // namespace strut
