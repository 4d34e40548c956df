#include "integrators/explicit/reaction_account.hpp"

#include <span>

#include "mechanics/mirror_forces.hpp"

namespace strut {

void ReactionAccount::gather(int conditions) {
  forces_.assign(conditions, Vector::Zero());
  substeps_ = ReactionImpulses(conditions);
}

void ReactionAccount::add_mirrors(const Body& body, const std::vector<Vector>& forces, double impulse_time,
                                  ReactionImpulses& impulses) {
  for (std::size_t m = 0; m < forces.size(); ++m) {
    impulses.add(number_of_side(body.domain, m), impulse_time * forces[m]);
  }
}

// The impulses of substeps belong to the step before this impulse.
void ReactionAccount::take(const ReactionImpulses& now, const MidSteps& steps, double impulse_time,
                           double previous_dt) {
  const double before = steps.before;
  impulses_ = {before * impulse_time, (1 - before) * impulse_time, substeps_.sums(), now.sums()};
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    impulses_.conditions_before[c] += before * now.sums()[c];
    impulses_.conditions_after[c] *= 1 - before;
    forces_[c] = now.sums()[c] / impulse_time;
    if (previous_dt > 0) forces_[c] += substeps_.sums()[c] / previous_dt;
  }
  substeps_ = none();
}

Reactions ReactionAccount::reactions(const Communicator& communicator) const {
  Reactions all{forces_};
  if (!all.forces.empty()) communicator.sum(std::span(all.forces[0].data(), 3 * all.forces.size()));
  return all;
}

}  // namespace strut
