// The work of all that acts on a body in explicit steps, and with the energies that the body holds the ledger.
#pragma once

#include "base/archive.hpp"
#include "conditions/conditions.hpp"
#include "conditions/mid_steps.hpp"
#include "contact/contact.hpp"
#include "integrators/ledger.hpp"

namespace strut {

class EnergyAccount {
 public:
  // Collective. Less energy than round-off makes counts as that much.
  void start(const Body& body) { largest_ = energy_of_round_off(body); }

  // The impulses at a time: their work is added to at_impulse(), then divided among the steps before and after.
  void begin_impulse();
  ImpulseWork& at_impulse() { return impulse_; }
  void end_impulse(const MidSteps& steps) { impulse_ = impulse_.split(steps); }
  // Adds the work of impulses between whole steps.
  void add(const ImpulseWork& work) { done_ = done_ + work.before + work.after; }

  // Collective. At the time of the impulses; `dt`: of the step after it.
  Ledger ledger(const Body& body, const Conditions& conditions, const contact::Contact& contact, const MidSteps& steps,
                double time, double dt);
  // Counts the energy that the body holds at the start as put in.
  void begin_with(const Ledger& ledger) { initial_ += ledger.gained; }

  void serialize(Archive& archive);

 private:
  Work done_;            // J, up to the mid-step before the time
  ImpulseWork impulse_;  // J, of the impulses at the time
  double initial_ = 0, largest_ = 0;
};

}  // namespace strut
