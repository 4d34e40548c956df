// Explicit central differences (leapfrog form): velocities are at mid-steps, positions and forces at steps.
#pragma once

#include "conditions/conditions.hpp"
#include "conditions/impulse_work.hpp"
#include "contact/contact.hpp"
#include "fracture/fracture.hpp"
#include "integrators/explicit/accounts.hpp"
#include "integrators/explicit/loads.hpp"
#include "integrators/explicit/multi_time_stepping.hpp"
#include "integrators/explicit/step_length.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

class CentralDifference {
 public:
  // Collective. Computes the initial forces and time step. Throws Error if the initial state already fails.
  CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                    double initial_time, std::optional<Fracture> fracture = {});
  // Collective. For a restart: computes no forces; serialize() must restore the state before any other call.
  struct ToBeRestored {};
  CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control, ToBeRestored,
                    std::optional<Fracture> fracture = {});

  double time() const { return time_; }
  int steps() const { return length_.steps(); }
  // Numbers of stress updates: so far, as the mean over all points; in one step, the largest of any point.
  double updates() const { return updates_; }
  int most_substeps() const { return most_substeps_; }
  double dt() const { return length_.dt(); }
  double critical_time_step() const { return length_.critical(contact_.stiffness()); }
  const contact::Contact& contact() const { return contact_; }
  const std::optional<Fracture>& fracture() const { return fracture_; }
  const Conditions& conditions() const { return conditions_; }

  // One step is advance_velocity(); then, if wanted, output and the ledger, both at time(); then
  // advance_position().
  // Updates velocities from the mid-step before time() to the one after, by loads, impulses and conditions. The step
  // does not pass `final_time`.
  void advance_velocity(double final_time);
  // Moves points to time() + dt, through the substeps of points of higher time-step levels; then updates stresses and
  // forces. Throws Error on all ranks if a point fails. `with_diagnostics`: the ledger or output will be needed at the
  // new time.
  void advance_position(bool with_diagnostics);

  Ledger ledger();  // collective; after advance_velocity()
  // Call it before the first step: continues the ledger of the solver before this one.
  void go_on_from(const Ledger& before);

  // Starts to add up the impulses of this number of conditions of the deck.
  void gather_reactions(int conditions) { reactions_.gather(conditions); }
  // Collective; after advance_velocity(). Reaction forces at time(), N: impulses divided by their time intervals.
  Reactions reactions() const { return reactions_.reactions(body_.domain.communicator); }
  // After advance_velocity(): the impulses at time().
  const StepImpulses& impulses() const { return reactions_.impulses(); }

  // Warning of the last advance_position(), on the ranks that own such a point. went_on(): true on all ranks if any
  // rank has a warning.
  const std::string& warning() const { return warning_; }
  bool went_on() const { return went_on_; }

  // The greatest request of any rank, agreed upon at the end of advance_position().
  enum class Request { none, save, stop };
  Request agreed_request() const { return agreed_request_; }
  void request(Request request) { request_ = request; }

  // Collective; between advance_position() and advance_velocity(). Saves or restores all that the next steps depend on,
  // including the body. A restored run continues identically to the last bit on the same number of ranks.
  void serialize(Archive& archive);
  // Collective. The same without the body and its broken bonds.
  void serialize_steps(Archive& archive);

 private:
  void start(const std::vector<std::uint8_t>& pushed);
  BondBreaking* breaking() { return fracture_ ? &*fracture_ : nullptr; }
  contact::Kinematics kinematics() const { return {body_.domain, body_.velocity, body_.density}; }
  PointTimeSteps point_steps() const {
    return {.whole = length_.dt(), .levels = &multi_stepping_.motion_levels(), .none_follows = length_.none_follows()};
  }
  std::vector<std::uint8_t> pushed_now() const;

  void kick(int i, double impulse_time);
  void constrain(double impulse_time);
  void count_work(double impulse_time);
  void even_out();
  std::vector<Vector> velocities_now();
  double energy_of_half_step(const std::vector<Vector>& inner) const;
  void drift(int i, const PointTimeSteps& steps);
  void drift_to_next_time();
  void reassign_levels(StepReport& report, const std::vector<std::uint8_t>& pushed);
  void restrict_conditions(const std::optional<std::vector<std::uint8_t>>& before);
  StepReport substeps();
  StepReport substep(int level, double t);
  void sum_all_forces(bool with_diagnostics);
  enum Severity { harmless, passable, fatal };
  Severity severity(const StepReport& report) const;
  void agree(const StepReport& report);
  void explain(const StepReport& report, const std::string& no_number);
  std::int64_t new_breaks();

  Body& body_;
  Conditions conditions_;
  contact::Contact contact_;
  std::optional<Fracture> fracture_;
  StepControl control_;
  StepLength length_;
  MultiTimeStepping multi_stepping_;
  std::vector<Conditions> conditions_of_level_;  // for the points that move at times between whole steps
  Loads loads_;
  Conditions changing_on_parts_;  // if there are substeps
  EnergyAccount energies_;
  ReactionAccount reactions_;
  MidSteps mid_steps_;                 // around time()
  std::vector<Vector> mirror_forces_;  // N, at time(), of domain.mirrors or periods on this rank's points
  double time_;
  int most_substeps_ = 1;
  double updates_ = 0;
  std::int64_t broken_ = 0;  // bonds of this rank's points, at the last agreement
  bool exposed_are_pushed_ = false;
  std::string warning_;
  bool went_on_ = false;
  Request request_ = Request::none, agreed_request_ = Request::none;
};

}  // namespace strut
