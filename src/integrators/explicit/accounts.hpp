// Sums over explicit steps: the work of external forces, and the impulses of conditions.
#pragma once

#include <vector>

#include "base/archive.hpp"
#include "conditions/conditions.hpp"
#include "conditions/impulse_work.hpp"
#include "conditions/reactions.hpp"
#include "contact/contact.hpp"
#include "integrators/ledger.hpp"
#include "mechanics/body.hpp"

namespace strut {

// The work of all external forces on a body; with the stored energies it gives the ledger.
class EnergyAccount {
 public:
  // Collective. Sets the smallest scale of the balance error: the energy that round-off makes. Work counts from here.
  void start(const Body& body);

  // Continues the ledger of the solver before this one, at the same time. Its work is counted on one rank
  // (`on_this_rank`), because it is a sum over all ranks; each rank counts the energy that its own contact stores
  // (`in_contact`, J).
  void go_on_from(const Ledger& before, bool on_this_rank, double in_contact);

  // Impulses at one time: their work is added to at_impulse(), then divided between the steps before and after.
  void begin_impulse();
  ImpulseWork& at_impulse() { return impulse_; }
  void end_impulse(const MidSteps& steps) { impulse_ = impulse_.split(steps); }
  // Adds the work of impulses in substeps.
  void add(const ImpulseWork& work) { done_ = done_ + work.before + work.after; }

  // Collective; at the time of the impulses. `dt`: length of the step after it, s.
  Ledger ledger(const Body& body, const Conditions& conditions, const contact::Contact& contact, const MidSteps& steps,
                double time, double dt);
  bool has_begun() const { return has_begun_; }  // true after begin_with()
  // Starts to count work at this impulse, without the part of it that belongs to the step before.
  void begin_at_this_impulse() { done_ = done_ + impulse_.before * -1; }
  // Counts the energy of the body at the first ledger as supplied before. `half_step`: J, counted as supplied from the
  // second ledger on, because a body that is strained at the start begins with half a step.
  void begin_with(const Ledger& ledger, double half_step) {
    initial_ += ledger.gained, half_step_ = half_step, has_begun_ = true;
  }

  void serialize(Archive& archive);

 private:
  Work done_;            // J, up to the mid-step before the present time
  ImpulseWork impulse_;  // J, of the impulses at the present time
  double initial_ = 0, half_step_ = 0, largest_ = 0;
  bool has_begun_ = false;
};

// Reactions: the impulses of conditions on the points of this rank.
class ReactionAccount {
 public:
  // Starts to add up the impulses of this number of conditions of the deck.
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
