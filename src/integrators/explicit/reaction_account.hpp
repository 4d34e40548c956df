// Reactions: the impulses of conditions on the points of this rank in explicit steps.
#pragma once

#include <vector>

#include "base/archive.hpp"
#include "conditions/mid_steps.hpp"
#include "conditions/reactions.hpp"
#include "mechanics/body.hpp"

namespace strut {

class ReactionAccount {
 public:
  // From now on, adds up impulses of this number of conditions of the deck.
  void gather(int conditions);
  ReactionImpulses none() const { return ReactionImpulses(static_cast<int>(forces_.size())); }

  // The impulses between whole steps.
  ReactionImpulses& of_substeps() { return substeps_; }
  // Adds the impulses of these forces (N), of domain.mirrors: mirror images act on the body as bonds do, without work.
  static void add_mirrors(const Body& body, const std::vector<Vector>& forces, double impulse_time,
                          ReactionImpulses& impulses);

  // At a time between two steps: stores the impulses over `impulse_time` (s). `previous_dt` (s): length of the step
  // before, 0 without one.
  void take(const ReactionImpulses& now, const MidSteps& steps, double impulse_time, double previous_dt);

  Reactions reactions(const Communicator& communicator) const;  // collective; N
  const StepImpulses& impulses() const { return impulses_; }

  void serialize(Archive& archive) { substeps_.serialize(archive); }

 private:
  std::vector<Vector> forces_;  // N, by condition; empty if not needed
  StepImpulses impulses_;
  ReactionImpulses substeps_;  // since the last whole step
};

}  // namespace strut
