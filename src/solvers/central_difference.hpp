// Explicit central differences (leap-frog form): velocities live at mid-steps, places and forces at steps.
#pragma once

#include "contact/contact.hpp"
#include "mechanics/conditions.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/subcycles.hpp"
#include "solvers/ledger.hpp"
#include "solvers/stable_step.hpp"

namespace strut {

struct StepControl {
  double fixed_dt = 0;  // s; 0: from the stable step
  double safety_factor = 0.8;
  bool subcycling = true;      // of the points that limit the step; none with a fixed one
  bool with_inverted = false;  // goes on with points that are turned inside out, as masses while they are
};

class CentralDifference {
 public:
  // Collective. Computes the initial forces and step. Throws Error when the initial state already fails.
  CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                    double initial_time);

  double time() const { return time_; }
  int steps() const { return steps_; }
  // So often the stress of a point was brought up to date, in the mean of all points, and of the one that was stepped
  // most often in a step.
  double updates() const { return updates_; }
  int most_substeps() const { return most_substeps_; }
  double dt() const { return dt_; }
  // 2/ω_max now, s: the last estimate, less where the deformation has gone on and where points touch.
  double stable_step() const;
  const contact::Contact& contact() const { return contact_; }

  // One step is kick(); then, if wanted, a look at the body and its ledger, both at time(); then move().
  // kick: velocities from the mid-step before time() to the one after. The step does not pass `final_time`.
  void kick(double final_time);
  // move: places to time() + dt, then stresses and forces there. Throws Error on all ranks when a point fails.
  // `with_views`: the ledger, or a look at the body, will be asked for at the new time.
  void move(bool with_views);

  Ledger ledger();  // collective; after kick()

  // From now on, impulses are gathered of as many conditions as the deck has.
  void gather_reactions(int conditions);
  // Collective; after kick(). Forces at time(): impulses over the times that they stand for.
  Reactions reactions() const;

  // What the last move() went on with, on the ranks that have such a point; the same on all ranks: whether any has.
  const std::string& warning() const { return warning_; }
  bool went_on() const { return went_on_; }

  // Of any rank: agreed upon by all at the end of move(), the greatest wish of all.
  enum class Wish { none, save, stop };
  Wish agreed() const { return agreed_; }
  void request(Wish wish) { wish_ = wish; }

  // Collective; between move() and kick(). All that the next steps depend on, of the body too. The run that restores it
  // goes on to the last bit on as many ranks.
  void keep(Archive& archive);

 private:
  contact::Crowd crowd() const;
  void add_work_of_friction(double kick);
  void take_reactions(const Impulses& now, double kick);
  void choose_step(double final_time);
  void estimate_step();
  void regroup(StepReport& report);
  void restrict_conditions();
  void keep_work(Archive& archive);
  StepReport substeps();
  StepReport substep(int order, double t);
  PointSteps point_steps() const { return {dt_, &subcycles_.motions()}; }
  void start();
  enum Gravity { harmless, passable, fatal };
  Gravity gravity(const StepReport& report) const;
  void check(const StepReport& report);
  double imbalance(const Ledger& now) const;

  Body& body_;
  Conditions conditions_;
  contact::Contact contact_;
  StepControl control_;
  StableStep stable_;
  Subcycles subcycles_;
  std::vector<Conditions> conditions_of_order_;  // of the points that move at times between steps
  Work work_;                                    // up to the mid-step before time()
  KickWork kick_work_;                           // of the impulses at time()
  std::vector<Vector> reactions_;  // N, on this rank's points at time(), by condition; empty: not asked for
  Impulses between_;               // of the substeps since the last kick
  double time_, next_time_ = 0, dt_ = 0, previous_dt_ = 0;
  double limit_ = 0, pace_ = 0, pace_at_estimate_ = 0, damping_ = 0;
  double put_in_ = 0, largest_energy_ = 0;
  int steps_ = 0, steps_since_estimate_ = 0, most_substeps_ = 1;
  double updates_ = 0;
  bool regroup_due_ = true, estimate_due_ = true;
  std::string warning_;
  bool went_on_ = false;
  Wish wish_ = Wish::none, agreed_ = Wish::none;
};

}  // namespace strut
