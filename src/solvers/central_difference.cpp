#include "solvers/central_difference.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <sstream>

#include "base/errors.hpp"
#include "base/timing.hpp"
#include "mechanics/keep.hpp"
#include "mechanics/undisturbed.hpp"
#include "points/parallel.hpp"

namespace strut {

namespace {

// The estimate is renewed when the largest pace has grown by this factor since the last one (until then the step
// shrinks in proportion), and after so many steps in any case, when it may also grow again.
constexpr double renewal_growth = 1.1;
constexpr int renewal_steps = 1000;

constexpr double round_off = 1e-6;  // of a step: times are sums of up to millions of steps

}  // namespace

CentralDifference::CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                                     double initial_time)
    : body_(body),
      conditions_(std::move(conditions)),
      contact_(std::move(contact)),
      control_(control),
      time_(initial_time) {
  body_.halvings.clear();
  for (MaterialBlock& block : body_.blocks) block.resting_pace = largest_pace(body_, block);
  find_undisturbed(body_);
  StepReport report = advance_stress(body_, 0, true);
  regroup(report);
  sum_forces(body_, true);
  contact_.add_forces(crowd(), 0, body_.force_density);
  check(report);
  estimate_step();
}

contact::Crowd CentralDifference::crowd() const { return {body_.domain, body_.velocity, body_.density}; }

void CentralDifference::estimate_step() {
  limit_ = stable_.estimate(body_);
  pace_at_estimate_ = pace_;
  estimate_due_ = false;
  steps_since_estimate_ = 0;
}

// The points that limit the step are chosen anew.
void CentralDifference::regroup(StepReport& report) {
  regroup_due_ = false;
  estimate_due_ = true;
  if (!control_.subcycling || control_.fixed_dt > 0) return;
  report.pace = subcycles_.choose(body_, control_.safety_factor);
  restrict_conditions();
}

void CentralDifference::restrict_conditions() {
  conditions_of_order_.clear();
  for (int m = 1; m <= subcycles_.orders(); ++m) {
    conditions_of_order_.push_back(restricted_to(conditions_, subcycles_.motions(), m));
  }
}

void CentralDifference::choose_step(double final_time) {
  previous_dt_ = dt_;
  const double left = final_time - time_;
  if (left <= 0 && steps_ > 0) return;  // no step follows: velocities at the end are the mean about equal ones
  // A fixed step is watched, too, more closely where it may have become too large: a warning should be true.
  const double growth = control_.fixed_dt > stable_step() ? 1.01 : renewal_growth;
  if (estimate_due_) estimate_step();
  regroup_due_ = pace_ > growth * pace_at_estimate_ || steps_since_estimate_ >= renewal_steps;
  if (control_.fixed_dt > 0) {
    // What round-off leaves after the last full step is no step of its own.
    dt_ = left < control_.fixed_dt * (1 + round_off) ? left : control_.fixed_dt;
  } else {
    // Equal steps to the end: a jump in dt at the last one would cost energy.
    dt_ = left / std::ceil(left / (control_.safety_factor * stable_step()) * (1 - round_off));
  }
  next_time_ = dt_ == left ? final_time : time_ + dt_;
}

void CentralDifference::kick(double final_time) {
  static Teuchos::Time& timer = phase("Motion and conditions");
  choose_step(final_time);
  const Timed timed(timer);
  add_body_forces(conditions_, time_, body_);
  if (steps_ == 0) start();
  const double kick = 0.5 * (previous_dt_ + dt_);
  work_ = work_ + kick_work_.before + kick_work_.after;
  kick_work_ = {};
  for_each_point(0, body_.owned(), [&](int i) {
    body_.previous_velocity[i] = body_.velocity[i];
    body_.velocity[i] += kick / body_.density[i] * body_.force_density[i];
  });
  Impulses impulses(static_cast<int>(reactions_.size()));
  constrain(conditions_, time_, point_steps(), body_, kick_work_, impulses);
  take_reactions(impulses, kick);
  add_work_of_body_forces(conditions_, time_, kick, body_, kick_work_);
  add_work_of_friction(kick);
  if (steps_ == 0) put_in_ = 0, put_in_ = imbalance(ledger());
}

// ω² of a sum of operators is at most the sum of theirs. A damping by the velocities of the mid-step before takes as
// much of the step as the formula of StepReport says.
double CentralDifference::stable_step() const {
  const double alone = limit_ * std::min(1.0, pace_at_estimate_ / pace_);
  const double undamped = alone / std::sqrt(1 + 0.25 * alone * alone * contact_.stiffness());
  return undamped * (std::sqrt(1 + damping_ * damping_) - damping_);
}

void CentralDifference::add_work_of_friction(double kick) {
  const contact::FrictionWork work = contact_.friction_work(kick, body_.previous_velocity, body_.velocity);
  kick_work_.before.contact += work.before;
  kick_work_.after.contact += work.after;
}

void CentralDifference::gather_reactions(int conditions) {
  reactions_.assign(conditions, Vector::Zero());
  between_ = Impulses(conditions);
}

// What a substep gives belongs to the step before this kick. The first kick begins half a step back, with velocities
// that conditions have not changed, and so they answer for half of it.
void CentralDifference::take_reactions(const Impulses& now, double kick) {
  const double length = steps_ == 0 ? 0.5 * kick : kick;
  for (std::size_t c = 0; c < reactions_.size(); ++c) {
    reactions_[c] = now.sums()[c] / length + between_.sums()[c] / previous_dt_;
  }
  between_ = Impulses(static_cast<int>(reactions_.size()));
}

Reactions CentralDifference::reactions() const {
  Reactions all{reactions_};
  if (!all.forces.empty()) body_.domain.communicator.sum(std::span(all.forces[0].data(), 3 * all.forces.size()));
  return all;
}

// Initial velocities belong to the initial time: the mid-step before it is half a step back.
void CentralDifference::start() {
  previous_dt_ = dt_;
  start_motions(conditions_, time_, dt_, body_);
  for_each_point(0, body_.owned(),
                 [&](int i) { body_.velocity[i] -= 0.5 * dt_ / body_.density[i] * body_.force_density[i]; });
}

// Between time() and the next: the kicks of the points that are stepped alone. Times of order m come every dt/2^m.
StepReport CentralDifference::substeps() {
  StepReport first;
  const int orders = subcycles_.orders();
  if (orders == 0) return first;
  static Teuchos::Time& timer = phase("Substeps");
  const Timed timed(timer);
  const int count = 1 << orders;
  for (int n = 1; n < count; ++n) {
    const int order = orders - std::countr_zero(static_cast<unsigned>(n));
    const StepReport report = substep(order, time_ + n * (dt_ / count));
    take_worse(report.failure, first.failure);
  }
  return first;
}

StepReport CentralDifference::substep(int order, double t) {
  const PointSteps steps = point_steps();
  const std::vector<int>& moved = subcycles_.moved(order);
  const int count = static_cast<int>(moved.size());
  for_each_point(0, count, [&](int n) {
    const int i = moved[n];
    body_.domain.sites[i].current.head<3>() += steps.of(i) * body_.velocity[i].array();
  });
  const double kick = std::ldexp(dt_, -order);
  const StepReport report = subcycles_.forces(body_, order, kick);
  for_each_point(0, count, [&](int n) {
    const int i = moved[n];
    body_.previous_velocity[i] = body_.velocity[i];
    body_.velocity[i] += kick / body_.density[i] * body_.force_density[i];
  });
  KickWork work;
  constrain(conditions_of_order_[order - 1], t, steps, body_, work, between_);
  work_ = work_ + work.before + work.after;
  return report;
}

void CentralDifference::move(bool with_views) {
  static Teuchos::Time& timer = phase("Motion and conditions");
  look_for_disturbances(body_);
  const StepReport between = substeps();
  {
    const Timed timed(timer);
    const PointSteps steps = point_steps();
    for_each_point(0, body_.owned(),
                   [&](int i) { body_.domain.sites[i].current.head<3>() += steps.of(i) * body_.velocity[i].array(); });
  }
  time_ = next_time_;
  ++steps_;
  ++steps_since_estimate_;
  updates_ += subcycles_.updates_a_point();
  most_substeps_ = std::max(most_substeps_, 1 << subcycles_.orders());
  StepReport report = advance_stress(body_, dt_, with_views);
  take_worse(between.failure, report.failure);
  if (regroup_due_) regroup(report);
  sum_forces(body_, with_views);
  contact_.add_forces(crowd(), dt_, body_.force_density);
  check(report);
}

// One reduction a step: whether a point failed anywhere, whether to stop, how far the deformation has gone, and what
// contact needs.
void CentralDifference::check(const StepReport& report) {
  std::vector<double> agreed{static_cast<double>(gravity(report)), static_cast<double>(wish_), report.pace,
                             report.damping};
  const std::size_t own = agreed.size();
  contact_.append_to_agree(crowd(), agreed);
  {
    static Teuchos::Time& timer = phase("Agreement of ranks");
    const Timed timed(timer);
    body_.domain.communicator.max(agreed);
  }
  agreed_ = static_cast<Wish>(agreed[1]);
  wish_ = Wish::none;
  pace_ = agreed[2];
  damping_ = agreed[3];
  contact_.take_agreed(std::span(agreed).subspan(own), dt_);
  const auto gravity = static_cast<Gravity>(agreed[0]);
  went_on_ = gravity == passable;
  warning_.clear();
  if (gravity == harmless) return;
  std::ostringstream text;
  if (report.failure) {
    text << "at t = " << time_ << " s, step " << steps_ << " of " << dt_ << " s: " << describe(*report.failure, body_);
  }
  if (!went_on_) raise_together(body_.domain.communicator, text.str());
  warning_ = text.str();
}

// A point that only is turned inside out has a place; others take their neighbours with them.
CentralDifference::Gravity CentralDifference::gravity(const StepReport& report) const {
  if (!report.failure) return harmless;
  return control_.with_inverted && report.failure->kind == Failure::Kind::inverted ? passable : fatal;
}

void CentralDifference::keep(Archive& archive) {
  strut::keep(archive, body_);
  subcycles_.keep(archive, body_);
  stable_.keep(archive, body_);
  archive.number("time", time_);
  archive.number("steps", steps_);
  archive.number("steps_since_estimate", steps_since_estimate_);
  archive.number("most_substeps", most_substeps_);
  archive.number("updates", updates_);
  archive.number("dt", dt_);
  archive.number("limit", limit_);
  archive.number("pace", pace_);
  archive.number("pace_at_estimate", pace_at_estimate_);
  archive.number("damping", damping_);
  archive.number("regroup_due", regroup_due_);
  archive.number("estimate_due", estimate_due_);
  keep_work(archive);
  contact_.keep(archive, crowd(), dt_);
  if (!archive.restores()) return;
  restrict_conditions();
  for (MaterialBlock& block : body_.blocks) {
    if (block.undisturbed) block.resting_pace = largest_pace(body_, block);
  }
}

void CentralDifference::keep_work(Archive& archive) {
  archive.number("put_in", put_in_);
  archive.number("largest_energy", largest_energy_);
  const auto keep = [&archive](const std::string& when, Work& work) {
    archive.share("external_work" + when, work.external);
    archive.share("contact_work" + when, work.contact);
  };
  keep("", work_);
  keep("_before", kick_work_.before);
  keep("_after", kick_work_.after);
  between_.keep(archive);
}

// What the body holds and has dissipated, less what was put in.
double CentralDifference::imbalance(const Ledger& now) const {
  return now.kinetic + now.elastic + now.dissipated + now.stabilization - now.contact - now.external - put_in_;
}

Ledger CentralDifference::ledger() {
  Ledger now;
  now.time = time_;
  now.dt = dt_;
  const Work done = work_ + kick_work_.before;
  double sums[6] = {0, done.contact - contact_.energy(), done.external, 0, 0, 0};
  for (int i = 0; i < body_.owned(); ++i) {
    const Vector &before = body_.previous_velocity[i], &after = body_.velocity[i];
    // ½ m v⁻·v⁺: with it central differences conserve the energy of a linear body exactly, at a constant step.
    sums[0] += 0.5 * body_.mass(i) * before.dot(after);
    for (int c = 0; c < 3; ++c) sums[3 + c] += body_.mass(i) * 0.5 * (before[c] + after[c]);
  }
  body_.domain.communicator.sum(sums);
  const Energies stored = stored_energies(body_);
  now.kinetic = sums[0];
  now.contact = sums[1];
  now.external = sums[2];
  now.momentum = Vector(sums[3], sums[4], sums[5]);
  now.elastic = stored.elastic;
  now.dissipated = stored.dissipated;
  now.stabilization = stored.stabilization;
  const double held = now.kinetic + now.elastic + now.dissipated + now.stabilization;
  largest_energy_ = std::max({largest_energy_, held, std::abs(put_in_ + now.contact + now.external)});
  now.balance_error = largest_energy_ > 0 ? std::abs(imbalance(now)) / largest_energy_ : 0;
  return now;
}

}  // namespace strut
