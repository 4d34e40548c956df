// Explicit central differences (leap-frog form): velocities live at mid-steps, places and forces at steps.
#pragma once

#include <limits>
#include <span>

#include "conditions/conditions.hpp"
#include "conditions/mid_steps.hpp"
#include "contact/contact.hpp"
#include "mechanics/mechanics.hpp"
#include "solvers/explicit/critical_time_step.hpp"
#include "solvers/explicit/multi_time_stepping.hpp"
#include "solvers/ledger.hpp"

namespace strut {

struct StepControl {
  double fixed_dt = 0;  // s; 0: from the critical time step
  double safety_factor = 0.8;
  bool subcycling = true;               // of the points that limit the step; none with a fixed one
  bool continue_with_inverted = false;  // inverted points carry no stress but keep their mass while det F ≤ 0
};

class CentralDifference {
 public:
  // Collective. Computes the initial forces and step. Throws Error when the initial state already fails.
  CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                    double initial_time);
  // One that serialize() is to restore before anything else is asked of it: nothing is computed.
  struct ToBeRestored {};
  CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control, ToBeRestored);

  double time() const { return time_; }
  int steps() const { return steps_; }
  // So often the stress of a point was brought up to date, in the mean of all points, and of the one that was stepped
  // most often in a step.
  double updates() const { return updates_; }
  int most_substeps() const { return most_substeps_; }
  double dt() const { return dt_; }
  // 2/ω_max now, s: the last estimate, less where the deformation has gone on and where points touch.
  double critical_time_step() const;
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
  void gather_reactions(int conditions);
  // Collective; after advance_velocity(). Forces at time(): impulses over the times that they stand for.
  Reactions reactions() const;
  // After advance_velocity(): at time().
  const StepImpulses& impulses() const { return impulses_; }

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
  contact::Kinematics kinematics() const;
  void choose_load_times(double final_time);
  void add_loads();
  void apply_force(int i, double impulse_time);
  void apply_conditions(double impulse_time);
  void even_out();
  void move(int i, const PointTimeSteps& steps);
  void move_points();
  void add_work_of_friction(double impulse_time);
  void take_reactions(const ReactionImpulses& now, double impulse_time);
  void choose_step(double final_time);
  double longest_stay() const;
  double longest_step(bool estimated);
  void estimate_step();
  void reassign_levels(StepReport& report, const std::vector<std::uint8_t>& pushed);
  void restrict_conditions();
  std::vector<std::uint8_t> pushed(std::span<const Vector> velocities, double dt) const;
  std::vector<std::uint8_t> damped() const;
  bool any_exposed(const std::vector<std::uint8_t>& marks) const;
  bool pushes_exposed_points() const;
  void serialize_work(Archive& archive);
  StepReport substeps();
  StepReport substep(int level, double t);
  PointTimeSteps point_steps() const { return {dt_, &multi_stepping_.motion_levels()}; }
  enum Severity { harmless, passable, fatal };
  Severity severity(const StepReport& report) const;
  void check(const StepReport& report);
  double put_in(const Ledger& now) const;
  void add_mirror_impulses(const std::vector<Vector>& forces, double impulse_time, ReactionImpulses& impulses) const;

  Body& body_;
  Conditions conditions_;
  contact::Contact contact_;
  StepControl control_;
  CriticalTimeStep critical_time_step_;
  MultiTimeStepping multi_stepping_;
  std::vector<Conditions> conditions_of_level_;  // of the points that move at times between steps
  Work work_;                                    // up to the mid-step before time()
  ImpulseWork impulse_work_;                     // of the impulses at time()
  MidSteps mid_steps_;                           // about time()
  std::vector<Vector> reaction_forces_;  // N, on this rank's points at time(), by condition; empty: not asked for
  StepImpulses impulses_;
  ReactionImpulses substep_impulses_;  // of the substeps since the last whole step
  std::vector<Vector> mirror_forces_;  // N, at time(), of domain.mirrors on this rank's points
  double time_, next_time_ = 0, dt_ = 0, previous_dt_ = 0;
  double least_chosen_ = std::numeric_limits<double>::infinity();  // s, since the last estimate
  double bound_of_step_ = 0,
         step_of_bound_ = 0;  // 1/s, s: the bound that levels were chosen for, the step that this led to
  double critical_at_estimate_ = 0, frequency_bound_ = 0, bound_at_estimate_ = 0, damping_ = 0;
  bool loads_change_ = false;
  std::vector<double> load_times_;  // s, at which loads are asked for the impulses at time()
  double initial_energy_ = 0, largest_energy_ = 0;
  int steps_ = 0, steps_since_estimate_ = 0, most_substeps_ = 1;
  double updates_ = 0;
  bool levels_due_ = true, estimate_due_ = true, levels_anew_ = false, exposed_are_pushed_ = false;
  std::string warning_;
  bool went_on_ = false;
  Request request_ = Request::none, agreed_request_ = Request::none;
};

}  // namespace strut
