// Slow loading: a series of equilibria without inertia. Time is only the argument of the loads.
#pragma once

#include "integrators/ledger.hpp"
#include "integrators/quasi_static/newton.hpp"
#include "integrators/quasi_static/relaxation.hpp"

namespace strut {

struct QuasiStaticControl {
  bool with_tangent = true;  // Newton, and relaxation if it fails; else relaxation alone
  int load_steps = 10;       // of equal length; shorter if one of these finds no equilibrium
  Tolerance tolerance;
};

class QuasiStatic {
 public:
  QuasiStatic(Body& body, Conditions conditions, contact::Contact contact, QuasiStaticControl control,
              double initial_time, double final_time, Observer observer, std::optional<Fracture> fracture = {});

  QuasiStatic(const QuasiStatic&) = delete;  // its searches refer to its other members

  // Memory that the search for equilibria takes on this rank, bytes.
  static double bytes(const Body& body, const QuasiStaticControl& control);

  double time() const { return time_; }
  double dt() const { return dt_; }
  int steps() const { return steps_; }
  int iterations() const { return iterations_; }    // of this run, including failed attempts
  int evaluations() const { return evaluations_; }  // of the forces, or of the tangent times a field
  const contact::Contact& contact() const { return equilibrium_.contact(); }
  // Call it after the last load step: hands contact, which remembers where bodies touch, to explicit steps.
  contact::Contact take_contact() { return equilibrium_.take_contact(); }
  std::optional<Fracture> take_fracture() { return equilibrium_.take_fracture(); }
  const Conditions& conditions() const { return equilibrium_.conditions(); }

  // Collective. Makes one load step; false if the observer requested a stop before it was made. Throws Error on all
  // ranks if no equilibrium is found, however short the step. In both cases the body is at its last equilibrium.
  bool advance();

  // Collective; between load steps. Saves or restores all that the next ones depend on, including the body. A restored
  // run continues identically to the last bit on the same number of ranks.
  void serialize(Archive& archive);
  // Collective. The same without the body and its broken bonds.
  void serialize_search(Archive& archive);
  // Collective, for a body that begins in the state of another run: its energy counts as put in before. `goes_on`: the
  // last load step has been restored; else the forces that hold the body fade over the first one. Load steps are as
  // long as this run has them.
  void begin_strained(bool goes_on);

  Ledger ledger();                                                                          // collective
  Reactions reactions(int conditions) const { return equilibrium_.reactions(conditions); }  // collective
  double missed_plastic_work() const { return missed_; }  // J, of all load steps and ranks (energies.hpp)

 private:
  EquilibriumSearch attempt();
  EquilibriumSearch search(bool with_tangent);
  EquilibriumSearch search_in_rounds(bool with_tangent);
  EquilibriumSearch search_from_start(bool with_tangent);
  void extrapolate();
  void take_work();
  void commit(EquilibriumSearch search);
  std::int64_t settle(EquilibriumSearch& search);
  void raise_no_equilibrium(const Imbalance& left, std::int64_t broken);
  void report(const EquilibriumSearch& search, std::int64_t broken) const;
  void serialize_steps(Archive& archive);

  Observer observer_;
  Equilibrium equilibrium_;
  Newton newton_;
  Relaxation relaxation_;
  QuasiStaticControl control_;
  double time_, final_time_, longest_, dt_, last_dt_ = 0;
  Field last_step_;  // m, of the last load step
  int steps_ = 0, iterations_ = 0, evaluations_ = 0;
  double put_in_ = 0, external_ = 0, by_tools_ = 0, by_friction_ = 0, in_jumps_ = 0, largest_energy_ = 0;
  double missed_ = 0;  // J, of plastic work
};

}  // namespace strut
