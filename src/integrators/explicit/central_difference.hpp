// Explicit central differences (leap-frog form): velocities live at mid-steps, places and forces at steps.
#pragma once

#include "conditions/conditions.hpp"
#include "conditions/mid_steps.hpp"
#include "contact/contact.hpp"
#include "fracture/fracture.hpp"
#include "integrators/explicit/energy_account.hpp"
#include "integrators/explicit/multi_time_stepping.hpp"
#include "integrators/explicit/reaction_account.hpp"
#include "integrators/explicit/step_length.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

class CentralDifference {
 public:
  // Collective. Computes the initial forces and step. Throws Error when the initial state already fails.
  CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                    double initial_time, std::optional<Fracture> fracture = {});
  // One that serialize() is to restore before anything else is asked of it: nothing is computed.
  struct ToBeRestored {};
  CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control, ToBeRestored,
                    std::optional<Fracture> fracture = {});

  double time() const { return time_; }
  int steps() const { return length_.steps(); }
  // So often the stress of a point was brought up to date, in the mean of all points, and of the one that was stepped
  // most often in a step.
  double updates() const { return updates_; }
  int most_substeps() const { return most_substeps_; }
  double dt() const { return length_.dt(); }
  double critical_time_step() const { return length_.critical(contact_.stiffness()); }
  const contact::Contact& contact() const { return contact_; }
  const Conditions& conditions() const { return conditions_; }

  // One step is advance_velocity(); then, if wanted, a look at the body and its ledger, both at time(); then
  // advance_position().
  // Velocities from the mid-step before time() to the one after: loads, impulses, conditions. The step does not pass
  // `final_time`.
  void advance_velocity(double final_time);
  // Places to time() + dt, by way of the substeps of points of higher time-step levels; then stresses and forces there.
  // Throws Error on all ranks when a point fails. `with_diagnostics`: the ledger, or a look at the body, will be asked
  // for at the new time.
  void advance_position(bool with_diagnostics);

  Ledger ledger();  // collective; after advance_velocity()

  // From now on, impulses are gathered of as many conditions as the deck has.
  void gather_reactions(int conditions) { reactions_.gather(conditions); }
  // Collective; after advance_velocity(). Forces at time(): impulses over the times that they stand for.
  Reactions reactions() const { return reactions_.reactions(body_.domain.communicator); }
  // After advance_velocity(): at time().
  const StepImpulses& impulses() const { return reactions_.impulses(); }

  // What the last advance_position() went on with, on the ranks that have such a point; the same on all ranks: whether
  // any has.
  const std::string& warning() const { return warning_; }
  bool went_on() const { return went_on_; }

  // Of any rank: agreed upon by all at the end of advance_position(), the greatest request of all.
  enum class Request { none, save, stop };
  Request agreed_request() const { return agreed_request_; }
  void request(Request request) { request_ = request; }

  // Collective; between advance_position() and advance_velocity(). All that the next steps depend on, of the body too.
  // The run that restores it goes on to the last bit on as many ranks.
  void serialize(Archive& archive);

 private:
  void start(const std::vector<std::uint8_t>& pushed);
  BondBreaking* breaking() { return fracture_ ? &*fracture_ : nullptr; }
  contact::Kinematics kinematics() const { return {body_.domain, body_.velocity, body_.density}; }
  PointTimeSteps point_steps() const { return {length_.dt(), &multi_stepping_.motion_levels()}; }
  std::vector<std::uint8_t> pushed_now() const;

  void choose_load_times(double final_time);
  void add_loads();
  void kick(int i, double impulse_time);
  void constrain(double impulse_time);
  void count_work(double impulse_time);
  void even_out();
  void drift(int i, const PointTimeSteps& steps);
  void drift_to_next_time();
  void reassign_levels(StepReport& report, const std::vector<std::uint8_t>& pushed);
  void restrict_conditions();
  StepReport substeps();
  StepReport substep(int level, double t);
  void sum_all_forces(bool with_diagnostics);
  enum Severity { harmless, passable, fatal };
  Severity severity(const StepReport& report) const;
  void agree(const StepReport& report);
  void tell(const StepReport& report, const std::string& no_number);

  Body& body_;
  Conditions conditions_;
  contact::Contact contact_;
  std::optional<Fracture> fracture_;
  StepControl control_;
  StepLength length_;
  MultiTimeStepping multi_stepping_;
  std::vector<Conditions> conditions_of_level_;  // of the points that move at times between steps
  EnergyAccount energies_;
  ReactionAccount reactions_;
  MidSteps mid_steps_;                 // about time()
  std::vector<Vector> mirror_forces_;  // N, at time(), of domain.mirrors on this rank's points
  std::vector<double> load_times_;     // s, at which loads are asked for the impulses at time()
  bool loads_change_ = false;
  double time_;
  int most_substeps_ = 1;
  double updates_ = 0;
  bool exposed_are_pushed_ = false;
  std::string warning_;
  bool went_on_ = false;
  Request request_ = Request::none, agreed_request_ = Request::none;
};

}  // namespace strut
