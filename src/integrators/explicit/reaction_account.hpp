// The impulses of conditions on the points of this rank in explicit steps, and the reactions that they make.
#pragma once

#include <vector>

#include "base/archive.hpp"
#include "conditions/mid_steps.hpp"
#include "conditions/reactions.hpp"
#include "mechanics/body.hpp"

namespace strut {

class ReactionAccount {
 public:
  // From now on, of as many conditions as the deck has.
  void gather(int conditions);
  ReactionImpulses none() const { return ReactionImpulses(static_cast<int>(forces_.size())); }

  // Between whole steps.
  ReactionImpulses& of_substeps() { return substeps_; }
  // The images of points act on the body as bonds do, without work: by these forces (N), of domain.mirrors.
  static void add_mirrors(const Body& body, const std::vector<Vector>& forces, double impulse_time,
                          ReactionImpulses& impulses);

  // At a time between the steps, over an impulse of `impulse_time` (s); `previous_dt` (s): of the step before, 0 where
  // there is none.
  void take(const ReactionImpulses& now, const MidSteps& steps, double impulse_time, double previous_dt);

  Reactions reactions(const Communicator& communicator) const;  // collective; N
  const StepImpulses& impulses() const { return impulses_; }

  void serialize(Archive& archive) { substeps_.serialize(archive); }

 private:
  std::vector<Vector> forces_;  // N, by condition; empty: not asked for
  StepImpulses impulses_;
  ReactionImpulses substeps_;  // since the last whole step
};

}  // namespace strut
