#include "integrators/explicit/accounts.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "base/errors.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/mirror_forces.hpp"

namespace strut {

void EnergyAccount::start(const Body& body) {
  largest_ = energy_of_round_off(body);
  done_.external = -work_of_expansion(body);  // so far, of another run
}

void EnergyAccount::go_on_from(const Ledger& before, bool on_this_rank, double in_contact) {
  done_.external = 0;
  if (on_this_rank)
    done_.external = before.external - before.expansion, done_.tools = before.tools, done_.contact = before.contact;
  done_.contact += in_contact;
  largest_ = std::max(largest_, before.largest);
}

void EnergyAccount::begin_impulse() {
  add(impulse_);
  impulse_ = {};
  initial_ += std::exchange(half_step_, 0);
}

Ledger EnergyAccount::ledger(const Body& body, const Conditions& conditions, const contact::Contact& contact,
                             const MidSteps& steps, double time, double dt) {
  raise_first(body.domain.communicator, conditions.first_not_finite());
  Ledger now{.time = time, .dt = dt};
  const Work done = done_ + impulse_.before;
  double sums[8] = {0, done.contact - contact.energy(), done.external, done.tools, 0, 0, 0, 0};
  for (int i = 0; i < body.owned(); ++i) {
    const Vector &after = body.velocity[i], now_here = 0.5 * (body.previous_velocity[i] + after);
    sums[0] += 0.5 * body.mass(i) * steps.conserved_square(now_here, after);
    for (int c = 0; c < 3; ++c) sums[4 + c] += body.mass(i) * now_here[c];
    sums[7] += 0.5 * body.mass(i) * after.squaredNorm();
  }
  body.domain.communicator.sum(sums);
  // The conserved energy is a difference of squares: for a body at rest that has just been struck, only their round-off
  // is left.
  constexpr double round_off_of_squares = 1e-9;
  largest_ = std::max(largest_, round_off_of_squares * sums[7]);
  now.take(stored_energies(body));
  now.kinetic = sums[0];
  now.tool_kinetic = kinetic_energy_of_tools(conditions);
  now.contact = sums[1];
  now.tools = sums[3];
  now.momentum = Vector(sums[4], sums[5], sums[6]);
  now.external = sums[2] + now.expansion;
  const double held = now.kinetic + now.tool_kinetic + now.elastic + now.dissipated + now.stabilization + now.fracture;
  now.balance(held, initial_ + now.tools + now.contact + now.external, largest_);
  return now;
}

void EnergyAccount::serialize(Archive& archive) {
  archive.number("put_in", initial_);
  archive.number("work_has_begun", has_begun_);
  archive.number("half_step", half_step_);
  archive.number("largest_energy", largest_);
  const auto serialize = [&archive](const std::string& when, Work& work) {
    archive.rank_sum("external_work" + when, work.external);
    archive.rank_sum("tool_work" + when, work.tools);
    archive.rank_sum("contact_work" + when, work.contact);
  };
  serialize("", done_);
  serialize("_before", impulse_.before);
  serialize("_after", impulse_.after);
}

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
