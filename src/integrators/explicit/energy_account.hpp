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

  // Impulses at one time: their work is added to at_impulse(), then divided between the steps before and after.
  void begin_impulse();
  ImpulseWork& at_impulse() { return impulse_; }
  void end_impulse(const MidSteps& steps) { impulse_ = impulse_.split(steps); }
  // Adds the work of impulses in substeps.
  void add(const ImpulseWork& work) { done_ = done_ + work.before + work.after; }

  // Collective; at the time of the impulses. `dt`: length of the step after it, s.
  Ledger ledger(const Body& body, const Conditions& conditions, const contact::Contact& contact, const MidSteps& steps,
                double time, double dt);
  // Counts the energy that the body has at the start as put in before: call it at the first ledger.
  bool has_begun() const { return has_begun_; }
  void begin_with(const Ledger& ledger) { initial_ += ledger.gained, has_begun_ = true; }

  void serialize(Archive& archive);

 private:
  Work done_;            // J, up to the mid-step before the present time
  ImpulseWork impulse_;  // J, of the impulses at the present time
  double initial_ = 0, largest_ = 0;
  bool has_begun_ = false;
};

}  // namespace strut
