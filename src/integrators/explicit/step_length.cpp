#include "integrators/explicit/step_length.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/errors.hpp"

namespace strut {

namespace {

// The estimate is renewed when the largest frequency bound has grown by this factor since the last one (until then the
// step shrinks in proportion), and after this number of steps in any case, when it may also grow.
constexpr double renewal_growth = 1.1;
constexpr int renewal_steps = 1000;

// Breaks may raise ω of points beside others that have lost bonds without raising the largest frequency bound, so the
// estimate is renewed after breaks, and where a tool begins to rub points of unlike levels. It costs some four steps
// and is made at most once in steps_a_renewal steps on average: each step earns 1 of an allowance, up to most_allowed,
// and each estimate takes steps_a_renewal from it.
constexpr int steps_a_renewal = 100, most_allowed = 10 * steps_a_renewal;

constexpr double round_off = 1e-6;  // of a step: times are sums over up to millions of steps
// s, of a run that begins late, where this is more
double round_off_at(double time) { return 4 * std::numeric_limits<double>::epsilon() * std::abs(time); }

// When an estimate of the critical time step has been renewed, the step grows only if it can by this factor, and only
// to the least value that was allowed since the previous estimate.
constexpr double least_growth = 4.0 / 3;

}  // namespace

// ω² of a sum of operators is at most the sum of theirs. Damping by the velocities of the mid-step before reduces the
// step by the formula of StepReport.
double StepLength::critical(double contact_stiffness) const {
  const double alone = critical_at_estimate_ * std::min(1.0, bound_at_estimate_ / frequency_bound_);
  if (!std::isfinite(alone)) return 2 / std::sqrt(contact_stiffness);  // points without bonds: infinite without touch
  const double undamped = alone / std::sqrt(1 + 0.25 * alone * alone * contact_stiffness);
  return undamped * (std::sqrt(1 + damping_ * damping_) - damping_);
}

double StepLength::wanted(double contact_stiffness) const {
  return control_.fixed_dt > 0 ? control_.fixed_dt : control_.safety_factor * critical(contact_stiffness);
}

double StepLength::bytes(const Body& body) {
  return CriticalTimeStep::bytes(body) + (body.may_break() ? body.force_states.bytes() : 0);
}

void StepLength::estimate(Body& body) {
  // The estimate overwrites the force states; a break in the next step needs them.
  std::optional<ForceStates> kept;
  if (body.may_break()) kept = body.force_states;
  critical_at_estimate_ = critical_time_step_.estimate(body);
  if (kept) body.force_states = std::move(*kept);
  bound_at_estimate_ = frequency_bound_;
  estimate_pending_ = false;
  changed_ = false;
  allowance_ -= steps_a_renewal;
  steps_since_estimate_ = 0;
}

void StepLength::choose(double time, double final_time, double contact_stiffness, bool exposed_are_pushed, Body& body) {
  previous_dt_ = dt_;
  const double left = final_time - time;
  none_follows_ = left <= 0 && dt_ > 0;
  if (none_follows_) {  // no step follows: the final velocities are those around a step of the usual length
    if (control_.fixed_dt > 0) dt_ = control_.fixed_dt;
    return;
  }
  // A fixed step is checked, too, more closely if it may have become too large, so that the warning is true.
  const double growth = control_.fixed_dt > critical(contact_stiffness) ? 1.01 : renewal_growth;
  const bool estimated = estimate_pending_;
  if (estimated) estimate(body);
  levels_pending_ = levels_pending_ || frequency_bound_ > growth * bound_at_estimate_ ||
                    steps_since_estimate_ >= renewal_steps || exposed_are_pushed || (changed_ && allowance_ >= 0);
  if (control_.fixed_dt > 0) return choose_fixed(time, final_time);
  // Equal steps to the end, because a jump of dt at the last step would cost energy.
  const double longest = longest_step(contact_stiffness, body.may_break(), estimated);
  if (std::isinf(longest)) {
    throw Error(
        "Solver > Verlet: nothing limits the time step: no point has neighbors or touches another, or stiffness is "
        "negligible beside the Density; expected a Fixed dt");
  }
  const double count = std::min(left / longest * (1 - round_off), (left - round_off_at(final_time)) / longest);
  dt_ = left / std::max(std::ceil(count), 1.0);
  if (levels_anew_) step_of_bound_ = dt_;
  levels_anew_ = false;
  next_time_ = dt_ == left ? final_time : time + dt_;
}

// Where whole steps lead to the final time, they end on the times from which they do: round-off of the sums would
// otherwise grow to a step of its own at the end.
void StepLength::choose_fixed(double time, double final_time) {
  const double fixed = control_.fixed_dt, left = final_time - time, steps = std::round(left / fixed);
  const bool fits = std::abs(left - steps * fixed) < std::max(round_off * fixed, round_off_at(final_time));
  const bool is_last = left < fixed || (fits && steps <= 1);
  dt_ = is_last ? left : fixed;
  next_time_ = is_last ? final_time : fits ? final_time - (steps - 1) * fixed : time + fixed;
}

// The longest step that is kept, as a fraction of the critical time step, whose bound fluctuates with the families of a
// few points while bonds break.
double StepLength::longest_stay(bool bonds_may_break) const {
  constexpr double most = 0.95, slack = 1.05;
  const double safety = control_.safety_factor, limit = std::max(most, safety);
  return bonds_may_break ? limit : std::min(slack * safety, limit);
}

// Changes that follow a vibration would feed energy to it: the step stays as it is while it is stable, and until it
// could be much longer.
double StepLength::longest_step(double contact_stiffness, bool bonds_may_break, bool estimated) {
  const double now = critical(contact_stiffness), chosen = control_.safety_factor * now;
  const double since = std::min(chosen, least_chosen_);
  least_chosen_ = estimated ? chosen : since;
  // Once no point has bonds or touches, nothing limits the step: it stays as it was.
  if (dt_ > 0 && !std::isfinite(chosen)) return dt_;
  if (dt_ == 0 || levels_anew_ || dt_ > longest_stay(bonds_may_break) * now) return chosen;
  return estimated && since >= least_growth * dt_ ? since : dt_;
}

void StepLength::count_step() {
  ++steps_, ++steps_since_estimate_;
  allowance_ = std::min(allowance_ + 1, most_allowed);
}

// A fixed step follows no bound.
PresentStep StepLength::present(bool bonds_may_break) const {
  const bool follows_bound = dt_ > 0 && control_.fixed_dt == 0;
  return {follows_bound ? bound_of_step_ * step_of_bound_ / dt_ : 0,
          longest_stay(bonds_may_break) / control_.safety_factor, dt_ == 0};
}

void StepLength::take_levels(const MultiTimeStepping& chosen) {
  levels_anew_ = chosen.anew();
  if (levels_anew_) bound_of_step_ = chosen.bound();
}

void StepLength::serialize(Archive& archive, const Body& body) {
  critical_time_step_.serialize(archive, body);
  archive.number("steps", steps_);
  archive.number("steps_since_estimate", steps_since_estimate_);
  archive.number("dt", dt_);
  archive.number("limit", critical_at_estimate_);
  archive.number("frequency_bound", frequency_bound_);
  archive.number("bound_at_estimate", bound_at_estimate_);
  archive.number("damping", damping_);
  archive.number("estimate_allowance", allowance_);
  archive.number("bonds_broke", changed_);
  archive.number("levels_due", levels_pending_);
  archive.number("estimate_due", estimate_pending_);
  archive.number("levels_anew", levels_anew_);
  archive.number("least_chosen", least_chosen_);
  archive.number("bound_of_step", bound_of_step_);
  archive.number("step_of_bound", step_of_bound_);
}

}  // namespace strut
