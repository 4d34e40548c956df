// The work of all external forces on a body in explicit steps; with the stored energies it gives the ledger.
#pragma once

#include "base/archive.hpp"
#include "conditions/conditions.hpp"
#include "conditions/mid_steps.hpp"
#include "contact/contact.hpp"
#include "integrators/ledger.hpp"

namespace strut {

class EnergyAccount {
 public:
  // Collective. Sets the smallest scale of the balance error: the energy that round-off makes.
  void start(const Body& body) { largest_ = energy_of_round_off(body); }

  // Goes on from the ledger of a solver before this one, at the same time; on one rank, with its contact. The others
  // take over what their contact stores.
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
  // Counts the energy that the body has at the first ledger as put in before. `half_step`: J, what is put in from the
  // second time on, because a body that is strained at the start begins with half a step.
  bool has_begun() const { return has_begun_; }
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

}  // namespace strut
