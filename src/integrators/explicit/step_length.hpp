// The length of explicit steps: a fraction of the critical time step, which is estimated from time to time and bounded
// in between. It is kept while it is stable, because each change adds or removes energy.
#pragma once

#include <limits>

#include "base/archive.hpp"
#include "integrators/explicit/critical_time_step.hpp"
#include "integrators/explicit/multi_time_stepping.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

struct StepControl {
  double fixed_dt = 0;  // s; 0: from the critical time step
  double safety_factor = 0.8;
  bool subcycling = true;               // of the points that limit the step; not with a fixed step
  bool continue_with_inverted = false;  // inverted points carry no stress but keep their mass while det F ≤ 0
};

inline bool may_subcycle(const StepControl& control) { return control.subcycling && control.fixed_dt == 0; }

class StepLength {
 public:
  explicit StepLength(const StepControl& control) : control_(control) {}

  // Memory that estimates take on this rank, bytes.
  static double bytes(const Body& body);

  double dt() const { return dt_; }                    // s, of the present or next step
  double previous_dt() const { return previous_dt_; }  // s, of the previous step; 0 before the first
  double next_time() const { return next_time_; }      // s, at the end of that step
  bool none_follows() const { return none_follows_; }  // true at the final time

  // 2/ω_max now, s: the last estimate, reduced by the deformation since, contact of this stiffness (1/s²) and damping.
  double critical(double contact_stiffness) const;
  // The length of step that the control asks for, s.
  double wanted(double contact_stiffness) const;

  // Collective. Estimates the critical time step anew.
  void estimate(Body& body);
  // Collective. Chooses the step after `time`, which does not pass `final_time`. `exposed_are_pushed`: contact acts on
  // points whose levels do not allow for it.
  void choose(double time, double final_time, double contact_stiffness, bool exposed_are_pushed, Body& body);
  // Takes the largest frequency bound (1/s) and damping of a point on any rank in a step, and whether it has changed
  // what levels should be: bonds broke, or a tool rubs other points.
  void take(double frequency_bound, double damping, bool changed) {
    frequency_bound_ = frequency_bound, damping_ = damping, changed_ = changed_ || changed;
  }
  void count_step();

  // Time-step levels: whether to choose them anew; the data of the present step that they need; the result.
  bool levels_pending() const { return levels_pending_; }
  void ask_for_levels() { levels_pending_ = true; }
  PresentStep present(bool bonds_may_break) const;
  void begin_levels() { levels_pending_ = false, estimate_pending_ = true; }
  void take_levels(const MultiTimeStepping& chosen);

  int steps() const { return steps_; }
  void serialize(Archive& archive, const Body& body);  // collective, at the group of all owned points

 private:
  void choose_fixed(double time, double final_time);
  double longest_stay(bool bonds_may_break) const;
  double longest_step(double contact_stiffness, bool bonds_may_break, bool estimated);

  StepControl control_;
  CriticalTimeStep critical_time_step_;
  double dt_ = 0, previous_dt_ = 0, next_time_ = 0;  // s
  bool none_follows_ = false;
  double least_chosen_ = std::numeric_limits<double>::infinity();  // s, since the last estimate
  double bound_of_step_ = 0;                                       // 1/s, frequency bound for which levels were chosen
  double step_of_bound_ = 0;                                       // s, length of the step that followed this choice
  double critical_at_estimate_ = 0, frequency_bound_ = 0, bound_at_estimate_ = 0, damping_ = 0;
  int steps_ = 0, steps_since_estimate_ = 0;
  int allowance_ = 0;  // steps made minus steps_a_renewal for each estimate: below 0, changes cause no estimate
  bool levels_pending_ = true, estimate_pending_ = true, levels_anew_ = false;
  bool changed_ = false;  // since the last estimate
};

}  // namespace strut
