#include "integrators/explicit/central_difference.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/timing.hpp"
#include "mechanics/mirror_forces.hpp"
#include "mechanics/rigid_motion.hpp"
#include "mechanics/serialize.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

// The largest b₁ of all blocks. It shortens the time step from the start. If it did so only while a point shrinks, the
// step would change as soon as a body is struck, and each change costs energy.
double linear_viscosity(const Body& body) {
  double most = 0;
  for (const MaterialBlock& block : body.blocks) most = std::max(most, block.material.viscosity.linear);
  return most;
}

}  // namespace

CentralDifference::CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                                     ToBeRestored, std::optional<Fracture> fracture)
    : body_(body),
      conditions_(std::move(conditions)),
      contact_(std::move(contact)),
      fracture_(std::move(fracture)),
      control_(control),
      length_(control),
      loads_(conditions_),
      time_(0) {
  energies_.start(body_);
  body_.time_levels->clear();
}

CentralDifference::CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                                     double initial_time, std::optional<Fracture> fracture)
    : CentralDifference(body, std::move(conditions), std::move(contact), control, ToBeRestored(), std::move(fracture)) {
  time_ = initial_time;
  body_.domain.stretch_sides(time_);
  for (MaterialBlock& block : body_.blocks) block.rest_frequency_bound = largest_frequency_bound(body_, block);
  find_rigid_motion(body_);
  start({});
  const double first = length_.wanted(contact_.stiffness());
  if (!std::isfinite(first)) return;
  const std::vector<Vector> velocities = predicted_velocities(conditions_, time_, first, body_);
  contact_.foresee({body_.domain, velocities, body_.density}, first);
  // Points that will be pushed within `soon` steps, or that the contact search found near others, get their time-step
  // levels now. A change of levels while bodies vibrate would add energy.
  constexpr double soon = 10;  // steps
  std::vector<std::uint8_t> marks = pushed_points(body_, conditions_, contact_, velocities, time_, soon * first);
  contact_.mark_near(marks);
  const bool exposed = any_in_both(marks, multi_stepping_.exposed());
  if (body_.domain.communicator.any(exposed)) start(marks);
}

void CentralDifference::start(const std::vector<std::uint8_t>& pushed) {
  body_.time_levels->clear();
  StepReport report = advance_stress(body_, 0, true, time_, breaking());
  reassign_levels(report, pushed);
  sum_all_forces(true);
  agree(report);
  length_.estimate(body_);
}

// ---- A step ---------------------------------------------------------------------------------------------------------

void CentralDifference::advance_velocity(double final_time) {
  static Teuchos::Time& timer = phase("Motion and conditions");
  length_.choose(time_, final_time, contact_.stiffness(), exposed_are_pushed_, body_);
  const Timed timed(timer);
  const double before = length_.previous_dt(), after = length_.dt(), impulse_time = 0.5 * (before + after);
  const bool is_first = before == 0;
  const std::vector<Vector> inner = is_first ? *body_.force_density : std::vector<Vector>();
  loads_.add({time_, before, after, final_time}, body_);
  // Initial velocities belong to the initial time, other velocities to mid-steps: the first impulse lasts half a step.
  if (is_first) body_.velocity = predicted_velocities(conditions_, time_, after, body_);
  mid_steps_.before = before / (before + after);
  for_each_point(0, body_.owned(), [&](int i) { kick(i, impulse_time); });
  constrain(impulse_time);
  count_work(impulse_time);
  loads_.end_whole_step();
  if (mid_steps_.before != 0.5) even_out();
  if (energies_.has_begun()) return;
  energies_.begin_at_this_impulse();
  energies_.begin_with(ledger(), is_first ? energy_of_half_step(inner) : 0);
}

// The scheme conserves the strain energy plus ½ m v⁻·v⁺ (v⁻, v⁺: velocities half a step before and after), at the start
// ½ m (v² − (½ Δt a)²). Returns the part of −½ m (½ Δt a)² that internal forces cause, J: no counted work contains it.
double CentralDifference::energy_of_half_step(const std::vector<Vector>& inner) const {
  double sum = 0;
  for (int i = 0; i < body_.owned(); ++i) {
    const Vector change = 0.5 * (body_.velocity[i] - body_.previous_velocity[i]);
    sum -= 0.25 * dt() * body_.domain.volume(i) * change.dot(inner[i]);
  }
  return body_.domain.communicator.sum(sum);
}

void CentralDifference::advance_position(bool with_diagnostics) {
  const bool substeps_of_rigid =
      multi_stepping_.level_count() > 0 && std::ranges::any_of(body_.blocks, &MaterialBlock::in_rigid_motion);
  std::vector<std::uint8_t> apart;  // points that the substeps will move otherwise than the rest of their bodies
  if (substeps_of_rigid) {
    apart = met_points(body_, conditions_, body_.velocity, time_, dt());
    const std::vector<std::uint8_t> moved =
        moved_within(changing_on_parts_, body_, time_, dt(), 1 << multi_stepping_.level_count());
    apart.resize(body_.owned(), 0);
    for (std::size_t i = 0; i < moved.size(); ++i) apart[i] |= moved[i];
  }
  update_rigid_motion(body_, apart);
  if (fracture_) {
    fracture_->start_criteria(body_);
    const Domain& domain = body_.domain;
    fracture_->start_step(body_, body_.velocity, dt(),
                          stretch_at(domain.periods, length_.next_time()) - domain.halo.stretch());
  }
  const StepReport between = substeps();
  drift_to_next_time();
  StepReport report = advance_stress(body_, dt(), with_diagnostics, time_, breaking());
  if (fracture_) fracture_->finish_criteria(body_);
  take_worse(between.failure, report.failure);
  if (length_.levels_pending()) reassign_levels(report, pushed_now());
  sum_all_forces(with_diagnostics);
  agree(report);
}

void CentralDifference::sum_all_forces(bool with_diagnostics) {
  sum_forces(body_, with_diagnostics, breaking());
  mirror_forces_ = mirror_forces(body_);
  contact_.add_forces(kinematics(), dt(), body_.force_density);
  contact_.add_mirror_reactions(body_.domain, mirror_forces_);
}

// Advances the points of higher time-step levels through their substeps between time() and the next whole time. Level m
// has a substep every dt/2^m.
StepReport CentralDifference::substeps() {
  StepReport first;
  const int levels = multi_stepping_.level_count();
  if (levels == 0) return first;
  static Teuchos::Time& timer = phase("Substeps");
  const Timed timed(timer);
  const int count = 1 << levels;
  for (int n = 1; n < count; ++n) {
    const int level = levels - std::countr_zero(static_cast<unsigned>(n));
    const StepReport report = substep(level, time_ + n * (dt() / count));
    take_worse(report.failure, first.failure);
  }
  return first;
}

StepReport CentralDifference::substep(int level, double t) {
  const PointTimeSteps steps = point_steps();
  const std::vector<int>& moved = multi_stepping_.moved(level);
  body_.domain.stretch_sides(t);
  const int count = static_cast<int>(moved.size());
  for_each_point(0, count, [&](int n) { drift(moved[n], steps); });
  const double impulse_time = std::ldexp(dt(), -level);
  const StepReport report = multi_stepping_.forces(body_, level, impulse_time, t);
  loads_.add({.time = t, .before = dt(), .after = dt(), .level = level}, body_);
  for_each_point(0, count, [&](int n) { kick(moved[n], impulse_time); });
  ReactionImpulses& impulses = reactions_.of_substeps();
  const std::vector<Vector> of_sides = mirror_forces(body_, level, &moved);
  ReactionAccount::add_mirrors(body_, of_sides, impulse_time, impulses);
  ImpulseWork work;
  add_period_work(body_.domain, of_sides, {t, impulse_time, impulse_time, impulse_time}, work);
  change_velocities(conditions_of_level_[level - 1], t, steps, body_, work, impulses);
  loads_.add_work(impulse_time, body_, work);
  energies_.add(work);
  return report;
}

// ---- Phases of a step -----------------------------------------------------------------------------------------------

void CentralDifference::kick(int i, double impulse_time) {
  body_.previous_velocity[i] = body_.velocity[i];
  body_.velocity[i] += impulse_time / body_.density[i] * body_.force_density[i];
}

// Constrains velocities by the conditions and adds up the reactions.
void CentralDifference::constrain(double impulse_time) {
  energies_.begin_impulse();
  ReactionImpulses impulses = reactions_.none();
  PointTimeSteps steps = point_steps();
  steps.impulse = impulse_time / dt();
  change_velocities(conditions_, time_, steps, body_, energies_.at_impulse(), impulses);
  ReactionAccount::add_mirrors(body_, mirror_forces_, impulse_time, impulses);
  add_period_work(body_.domain, mirror_forces_, {time_, length_.previous_dt(), dt(), impulse_time},
                  energies_.at_impulse());
  reactions_.take(impulses, mid_steps_, impulse_time, length_.previous_dt());
}

// Adds the work of loads and friction. Call it once velocities are final.
void CentralDifference::count_work(double impulse_time) {
  ImpulseWork& work = energies_.at_impulse();
  loads_.add_work(impulse_time, body_, work);
  const contact::FrictionWork friction = contact_.friction_work(impulse_time, body_.previous_velocity, body_.velocity);
  work.before.contact += friction.before;
  work.after.contact += friction.after;
  energies_.end_impulse(mid_steps_);
}

// Output shows the mean of the velocities before and after time() as the velocity at time(), which is right for equal
// steps. If the steps differ, this replaces the velocity before, so that the mean is the velocity at time().
void CentralDifference::even_out() {
  for_each_point(0, body_.owned(), [&](int i) {
    Vector& before = body_.previous_velocity[i];
    before = 2 * mid_steps_.velocity(before, body_.velocity[i]) - body_.velocity[i];
  });
}

// Collective; before advance_velocity(). The velocities of owned points at time(), m/s: means of the velocities before
// and after the impulse of a step as long as the last one. Leaves the body as it was.
std::vector<Vector> CentralDifference::velocities_now() {
  const auto owned = [this](const std::vector<Vector>& all) {
    return std::vector<Vector>(all.begin(), all.begin() + body_.owned());
  };
  const std::vector<Vector> before = owned(*body_.velocity), previous = owned(*body_.previous_velocity),
                            forces = *body_.force_density;
  if (dt() == 0) return before;
  const auto pass_tools = [this](Archive archive) {
    archive.points("all points", owned_ids(body_));
    serialize_tools(archive, conditions_, body_.owned());
  };
  Snapshot tools;
  pass_tools(Archive::saving_to(tools));
  loads_.add({time_, dt(), dt(), time_}, body_);  // none after this time, which may be the last
  for_each_point(0, body_.owned(), [&](int i) { kick(i, dt()); });
  ReactionImpulses impulses = reactions_.none();
  ImpulseWork work;
  PointTimeSteps steps = point_steps();
  steps.none_follows = true;  // a motion that ends here goes on, as in the last frame
  change_velocities(conditions_, time_, steps, body_, work, impulses);
  pass_tools(Archive::loading_from(tools));
  std::vector<Vector> now(before.size());
  for (std::size_t i = 0; i < now.size(); ++i) now[i] = 0.5 * (before[i] + body_.velocity[i]);
  std::ranges::copy(before, body_.velocity.begin());
  std::ranges::copy(previous, body_.previous_velocity.begin());
  std::ranges::copy(forces, body_.force_density.begin());
  return now;
}

void CentralDifference::drift(int i, const PointTimeSteps& steps) {
  body_.domain.sites[i].current.head<3>() += steps.of(i) * body_.velocity[i].array();
}

void CentralDifference::drift_to_next_time() {
  static Teuchos::Time& timer = phase("Motion and conditions");
  const Timed timed(timer);
  const PointTimeSteps steps = point_steps();
  for_each_point(0, body_.owned(), [&](int i) { drift(i, steps); });
  time_ = length_.next_time();
  body_.domain.stretch_sides(time_);
  length_.count_step();
  updates_ += multi_stepping_.updates_a_point();
  most_substeps_ = std::max(most_substeps_, 1 << multi_stepping_.level_count());
}

std::vector<std::uint8_t> CentralDifference::pushed_now() const {
  return pushed_points(body_, conditions_, contact_, body_.velocity, time_, dt());
}

void CentralDifference::reassign_levels(StepReport& report, const std::vector<std::uint8_t>& pushed) {
  length_.begin_levels();
  const std::vector<std::uint8_t> before = multi_stepping_.motion_levels();
  const bool had_substeps = multi_stepping_.level_count() > 0;
  const PresentStep present = length_.present(body_.may_break());
  if (!may_subcycle(control_)) {
    if (multi_stepping_.level_count() == 0) return;
    report.frequency_bound =
        multi_stepping_.drop(body_, present);  // the run before had substeps, this deck allows none
  } else {
    const std::vector<std::uint8_t> damped = damped_points(body_, conditions_),
                                    rubbed = rubbed_points(body_, conditions_, body_.velocity, time_, dt());
    report.frequency_bound = multi_stepping_.choose(body_, control_.safety_factor, present, {pushed, damped, rubbed});
  }
  const bool may_differ = had_substeps || multi_stepping_.level_count() > 0;
  restrict_conditions(may_differ ? std::optional(before) : std::nullopt);
  length_.take_levels(multi_stepping_);
}

// Collective. `before`: levels of the motion in the last step, if they were others.
void CentralDifference::restrict_conditions(const std::optional<std::vector<std::uint8_t>>& before) {
  loads_.take_levels(body_, before, multi_stepping_.motion_levels(), multi_stepping_.level_count());
  changing_on_parts_ = multi_stepping_.level_count() > 0 ? changing_on_parts(conditions_, body_) : Conditions();
  conditions_of_level_.clear();
  for (int m = 1; m <= multi_stepping_.level_count(); ++m) {
    conditions_of_level_.push_back(in_substeps(conditions_, {multi_stepping_.motion_levels(), m}));
  }
}

// Collective. The only reduction of a step, by maximum: whether a point has failed, whether to stop, the frequency
// bound (1/s), the damping, whether exposed points are pushed, whether bonds broke or a tool rubs points of unlike
// levels, and the numbers of contact.
void CentralDifference::agree(const StepReport& report) {
  const std::string no_number = conditions_.first_not_finite();
  const std::vector<std::uint8_t>& exposed = multi_stepping_.exposed();
  constexpr int steps_a_look = 8;  // each costs some hundredths of a step
  const bool rubs_unlike = multi_stepping_.level_count() > 0 && steps() % steps_a_look == 0 &&
                           is_uneven(body_, rubbed_points(body_, conditions_, body_.velocity, time_, dt()));
  std::vector<double> agreed{static_cast<double>(no_number.empty() ? severity(report) : fatal),
                             static_cast<double>(request_),
                             report.frequency_bound,
                             report.damping,
                             !exposed.empty() && any_in_both(pushed_now(), exposed) ? 1.0 : 0.0,
                             static_cast<double>(new_breaks() + (rubs_unlike ? 1 : 0))};
  const std::size_t own = agreed.size();
  contact_.append_to_agree(kinematics(), agreed);
  {
    static Teuchos::Time& timer = phase("Agreement of ranks");
    const Timed timed(timer);
    body_.domain.communicator.max(agreed);
  }
  agreed_request_ = static_cast<Request>(agreed[1]);
  request_ = Request::none;
  length_.take(agreed[2], std::max(agreed[3], linear_viscosity(body_)), agreed[5] > 0);
  exposed_are_pushed_ = agreed[4] > 0;
  contact_.take_agreed(std::span(agreed).subspan(own), dt());
  const auto severity = static_cast<Severity>(agreed[0]);
  went_on_ = severity == passable;
  warning_.clear();
  if (severity != harmless) explain(report, no_number);
}

// The number of bonds of this rank's points that have broken since the last call.
std::int64_t CentralDifference::new_breaks() {
  const std::int64_t before = std::exchange(broken_, broken_bonds(body_));
  return broken_ - before;
}

// Collective. Throws Error unless the run may continue with this report; else sets the warning.
void CentralDifference::explain(const StepReport& report, const std::string& no_number) {
  const Communicator& ranks = body_.domain.communicator;
  raise_first(ranks, no_number);
  if (report.failure)
    warning_ = text_of("at t = ", time_, " s, step ", steps(), " of ", dt(), " s: ", describe(*report.failure, body_));
  if (!went_on_) raise_together(ranks, warning_);
}

// An inverted point still has a position, so a run may continue with it; other failures spread to the neighbors.
CentralDifference::Severity CentralDifference::severity(const StepReport& report) const {
  if (!report.failure) return harmless;
  return control_.continue_with_inverted && report.failure->kind == Failure::Kind::inverted ? passable : fatal;
}

Ledger CentralDifference::ledger() { return energies_.ledger(body_, conditions_, contact_, mid_steps_, time_, dt()); }

void CentralDifference::go_on_from(const Ledger& before) {
  energies_.go_on_from(before, body_.domain.communicator.rank() == 0, contact_.energy());
}

void CentralDifference::serialize(Archive& archive) {
  strut::serialize(archive, body_);
  std::vector<Vector> now = archive.loading() ? std::vector<Vector>(body_.owned()) : velocities_now();
  archive.field("velocity_now", 3, [&now](std::size_t i, int c) -> double& { return now[i][c]; });  // for Start From
  if (fracture_) fracture_->serialize(archive, body_);
  serialize_steps(archive);
}

void CentralDifference::serialize_steps(Archive& archive) {
  archive.number("time", time_);
  archive.points("all points", owned_ids(body_));
  multi_stepping_.serialize(archive, body_);
  loads_.serialize(archive, body_);
  length_.serialize(archive, body_);
  serialize_tools(archive, conditions_, body_.owned());
  archive.number("most_substeps", most_substeps_);
  archive.number("updates", updates_);
  archive.number("exposed_are_pushed", exposed_are_pushed_);
  energies_.serialize(archive);
  reactions_.serialize(archive);
  mirror_forces_.resize(side_count(body_.domain), Vector::Zero());
  serialize_mirror_forces(archive, mirror_forces_);
  contact_.serialize(archive, kinematics(), dt());
  if (fracture_) fracture_->serialize_steps(archive);
  if (!archive.loading()) return;
  new_breaks();
  restrict_conditions(loads_.levels_before());
  if (!may_subcycle(control_) && multi_stepping_.level_count() > 0) length_.ask_for_levels();
  for (MaterialBlock& block : body_.blocks) {
    // The frequency bound at rest is needed in rigid motion, and by ordinary solids, whose bound is always that at
    // rest.
    if (!block.in_rigid_motion && !block.is_ordinary()) continue;
    block.rest_frequency_bound = largest_frequency_bound(body_, block);
  }
}

}  // namespace strut
