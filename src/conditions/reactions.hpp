// The reaction forces of conditions on the points of the body: solvers of any kind add them up, the history reads
// them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "base/math/tensors.hpp"

namespace strut {

// The reaction index of conditions without a reaction.
constexpr int no_reaction = -1;

// Reactions of all conditions at one time, N, summed over all ranks, by the condition's index in the deck; zero for
// those without a reaction. Empty if no reactions were asked for.
struct Reactions {
  std::vector<Vector> forces;
};

// Impulses at a time of explicit steps, on this rank: `before`, `after`: times for which forces act before and after
// it, s; impulses of conditions, N s, by the condition's index in the deck, including those since the time before.
// Empty if not asked for.
struct StepImpulses {
  double before = 0, after = 0;
  std::vector<Vector> conditions_before, conditions_after;
};

// The impulses of conditions on the points of this rank, N s, by the condition's index in the deck; divided by their
// time interval they are reactions. With no conditions it adds up nothing.
class ReactionImpulses {
 public:
  explicit ReactionImpulses(int conditions = 0) : sums_(conditions, Vector::Zero()) {}

  void add(int reaction_index, const Vector& impulse) {
    if (static_cast<std::size_t>(reaction_index) < sums_.size()) sums_[reaction_index] += impulse;  // not no_reaction
  }
  const std::vector<Vector>& sums() const { return sums_; }

  void serialize(Archive& archive) {
    for (std::size_t c = 0; c < sums_.size(); ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        archive.rank_sum("impulse_" + std::to_string(c) + "xyz"[axis], sums_[c][axis]);
      }
    }
  }

 private:
  std::vector<Vector> sums_;
};

}  // namespace strut
