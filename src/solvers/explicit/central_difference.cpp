#include "solvers/explicit/central_difference.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <sstream>

#include "base/errors.hpp"
#include "base/timing.hpp"
#include "mechanics/fracture/fracture.hpp"
#include "mechanics/mirror_forces.hpp"
#include "mechanics/rigid_motion.hpp"
#include "mechanics/serialize.hpp"
#include "points/parallel_for.hpp"

namespace strut {

namespace {

// The estimate is renewed when the largest frequency bound has grown by this factor since the last one (until then the
// step shrinks in proportion), and after so many steps in any case, when it may also grow again.
constexpr double renewal_growth = 1.1;
constexpr int renewal_steps = 1000;

constexpr double round_off = 1e-6;  // of a step: times are sums of up to millions of steps

// The step grows by this factor at least, when an estimate of the critical time step has been renewed, and to what
// would have done since the one before.
constexpr double least_growth = 4.0 / 3;

// What every point has that shrinks, the slowest, too: a step that took it only while one does would change as soon as
// a body is struck, and each change costs energy.
double linear_viscosity(const Body& body) {
  double most = 0;
  for (const MaterialBlock& block : body.blocks) most = std::max(most, block.material.viscosity.linear);
  return most;
}

}  // namespace

CentralDifference::CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                                     ToBeRestored)
    : body_(body), conditions_(std::move(conditions)), contact_(std::move(contact)), control_(control), time_(0) {
  loads_change_ = depend_on_time(conditions_, Stage::forces);
  body_.time_levels.clear();
}

CentralDifference::CentralDifference(Body& body, Conditions conditions, contact::Contact contact, StepControl control,
                                     double initial_time)
    : CentralDifference(body, std::move(conditions), std::move(contact), control, ToBeRestored()) {
  time_ = initial_time;
  for (MaterialBlock& block : body_.blocks) block.rest_frequency_bound = largest_frequency_bound(body_, block);
  find_rigid_motion(body_);
  largest_energy_ = energy_of_round_off(body_);
  start({});
  const double first = control_.fixed_dt > 0 ? control_.fixed_dt : control_.safety_factor * critical_time_step();
  if (!std::isfinite(first)) return;
  const std::vector<Vector> velocities = predicted_velocities(conditions_, time_, first, body_);
  contact_.foresee({body_.domain, velocities, body_.density}, first);
  // What touches in the first step, or is so near that it soon may, has its levels and its step from the start: a
  // change once bodies vibrate gives energy.
  constexpr double soon = 10;  // steps
  std::vector<std::uint8_t> marks = pushed(velocities, soon * first);
  contact_.mark_near(marks);
  if (body_.domain.communicator.max(any_exposed(marks) ? 1.0 : 0.0) > 0) start(marks);
}

void CentralDifference::start(const std::vector<std::uint8_t>& pushed) {
  body_.time_levels.clear();
  StepReport report = advance_stress(body_, 0, true);
  reassign_levels(report, pushed);
  sum_forces(body_, true);
  mirror_forces_ = mirror_forces(body_);
  contact_.add_forces(kinematics(), 0, body_.force_density);
  check(report);
  estimate_step();
}

contact::Kinematics CentralDifference::kinematics() const { return {body_.domain, body_.velocity, body_.density}; }

void CentralDifference::estimate_step() {
  // The estimate takes the force states for its own; a break in the next step asks what they were.
  std::optional<ForceStates> kept;
  if (body_.fracture) kept = body_.force_states;
  critical_at_estimate_ = critical_time_step_.estimate(body_);
  if (kept) body_.force_states = std::move(*kept);
  bound_at_estimate_ = frequency_bound_;
  estimate_due_ = false;
  steps_since_estimate_ = 0;
}

// The points that limit the step are chosen anew.
void CentralDifference::reassign_levels(StepReport& report, const std::vector<std::uint8_t>& pushed) {
  levels_due_ = false;
  estimate_due_ = true;
  if (!control_.subcycling || control_.fixed_dt > 0) return;
  const double safety = control_.safety_factor;
  report.frequency_bound = multi_stepping_.choose(
      body_, safety, {steps_ > 0 ? bound_of_step_ * step_of_bound_ / dt_ : 0, longest_stay() / safety}, pushed,
      damped());
  restrict_conditions();
  levels_anew_ = multi_stepping_.anew();
  if (levels_anew_) bound_of_step_ = multi_stepping_.bound();
}

// Whether contact, or a tool with a mass, acts on an owned point or is about to: once a step, on both alike. Empty
// where there is neither. A tool meets points between steps, too, by these velocities before the levels of the next
// step but one are there.
std::vector<std::uint8_t> CentralDifference::pushed(std::span<const Vector> velocities, double dt) const {
  constexpr double steps = 2, near = 0.05;  // so many spacings besides, for what changes meanwhile
  std::vector<std::uint8_t> marks(body_.owned(), 0);
  contact_.mark_touching(marks);
  bool any = contact_.any();
  for (const RigidTool& tool : tools_of(conditions_)) {
    if (!tool.free) continue;
    any = true;
    const Vector offset = tool.offset(time_);
    for (const int i : tool.points) {
      const Vector place = body_.current(i) - offset;
      const Surface at = std::visit([&](const auto& shape) { return tool.met_by(i, shape, place); }, tool.shape);
      const double closing = std::max(0.0, at.normal.dot(tool.free->velocity - velocities[i]));
      if (at.gap < steps * dt * closing + near * body_.domain.cloud.spacings[i]) marks[i] = 1;
    }
  }
  return any ? marks : std::vector<std::uint8_t>();
}

// Points whose motion a condition damps. Empty where none does.
std::vector<std::uint8_t> CentralDifference::damped() const {
  std::vector<std::uint8_t> marks;
  conditions_.visit([&]<class Type>(const Type& one) {
    if constexpr (Type::stage == Stage::drags) {
      marks.resize(body_.owned(), 0);
      for (const auto& drag : one.drags) marks[drag.point] = 1;
    }
  });
  return marks;
}

bool CentralDifference::pushes_exposed_points() const {
  return !multi_stepping_.exposed().empty() && any_exposed(pushed(body_.velocity, dt_));
}

bool CentralDifference::any_exposed(const std::vector<std::uint8_t>& marks) const {
  const std::vector<std::uint8_t>& exposed = multi_stepping_.exposed();
  if (exposed.empty()) return false;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] && exposed[i]) return true;
  }
  return false;
}

void CentralDifference::restrict_conditions() {
  conditions_of_level_.clear();
  for (int m = 1; m <= multi_stepping_.level_count(); ++m) {
    conditions_of_level_.push_back(in_substeps(conditions_, {multi_stepping_.motion_levels(), m}));
  }
}

void CentralDifference::choose_step(double final_time) {
  previous_dt_ = dt_;
  const double left = final_time - time_;
  if (left <= 0 && steps_ > 0) {  // no step follows: velocities at the end are those about one as long as usual
    if (control_.fixed_dt > 0) dt_ = control_.fixed_dt;
    return;
  }
  // A fixed step is watched, too, more closely where it may have become too large: a warning should be true.
  const double growth = control_.fixed_dt > critical_time_step() ? 1.01 : renewal_growth;
  const bool estimated = estimate_due_;
  if (estimated) estimate_step();
  levels_due_ =
      frequency_bound_ > growth * bound_at_estimate_ || steps_since_estimate_ >= renewal_steps || exposed_are_pushed_;
  if (control_.fixed_dt > 0) {
    // What round-off leaves after the last full step is no step of its own.
    dt_ = left < control_.fixed_dt * (1 + round_off) ? left : control_.fixed_dt;
  } else {
    // Equal steps to the end: a jump in dt at the last one would cost energy.
    dt_ = left / std::ceil(left / longest_step(estimated) * (1 - round_off));
    if (levels_anew_) step_of_bound_ = dt_;
    levels_anew_ = false;
  }
  next_time_ = dt_ == left ? final_time : time_ + dt_;
}

// As a part of the critical time step. Where bonds break its bound goes up and down with the families of a few points.
double CentralDifference::longest_stay() const {
  constexpr double most = 0.95, slack = 1.05;
  const double safety = control_.safety_factor, limit = std::max(most, safety);
  return body_.fracture ? limit : std::min(slack * safety, limit);
}

// Each change of the step takes or gives energy, in proportion to it, and changes that follow a vibration feed it: the
// step stays as it is while it is stable, and until it could be much longer.
double CentralDifference::longest_step(bool estimated) {
  const double critical = critical_time_step(), chosen = control_.safety_factor * critical;
  const double since = std::min(chosen, least_chosen_);
  least_chosen_ = estimated ? chosen : since;
  if (steps_ == 0 || levels_anew_ || dt_ > longest_stay() * critical) return chosen;
  return estimated && since >= least_growth * dt_ ? since : dt_;
}

void CentralDifference::advance_velocity(double final_time) {
  static Teuchos::Time& timer = phase("Motion and conditions");
  choose_step(final_time);
  const Timed timed(timer);
  choose_load_times(final_time);
  add_loads();
  // Initial velocities are those of the initial time: the first impulse is of half a step.
  if (steps_ == 0) body_.velocity = predicted_velocities(conditions_, time_, dt_, body_);
  mid_steps_.before = previous_dt_ / (previous_dt_ + dt_);
  const double impulse_time = 0.5 * (previous_dt_ + dt_);
  for_each_point(0, body_.owned(), [&](int i) { apply_force(i, impulse_time); });
  apply_conditions(impulse_time);
  if (steps_ == 0) initial_energy_ = 0, initial_energy_ = ledger().gained;
}

// Loads act once a step, by what they are at time(). With substeps a step is long, and loads that change in it act by
// their mean over the time of the impulse, at as many times as there are substeps.
void CentralDifference::choose_load_times(double final_time) {
  const int count = loads_change_ ? 1 << multi_stepping_.level_count() : 1;
  load_times_.assign(1, time_);
  if (count == 1) return;
  const double begin = time_ - 0.5 * previous_dt_, end = std::min(time_ + 0.5 * dt_, final_time);
  load_times_.clear();
  for (int n = 0; n < count; ++n) load_times_.push_back(begin + (n + 0.5) / count * (end - begin));
}

void CentralDifference::add_loads() {
  if (load_times_.size() == 1) return add_forces(conditions_, load_times_[0], body_);
  std::vector<Vector> others(body_.owned(), Vector::Zero());
  std::swap(others, body_.force_density);
  for (const double t : load_times_) add_forces(conditions_, t, body_);
  const double part = 1 / static_cast<double>(load_times_.size());
  for_each_point(0, body_.owned(), [&](int i) { body_.force_density[i] = others[i] + part * body_.force_density[i]; });
}

void CentralDifference::apply_force(int i, double impulse_time) {
  body_.previous_velocity[i] = body_.velocity[i];
  body_.velocity[i] += impulse_time / body_.density[i] * body_.force_density[i];
}

// Their changes of the velocities, their reactions, and the work of all impulses at time().
void CentralDifference::apply_conditions(double impulse_time) {
  work_ = work_ + impulse_work_.before + impulse_work_.after;
  impulse_work_ = {};
  ReactionImpulses impulses(static_cast<int>(reaction_forces_.size()));
  PointTimeSteps steps = point_steps();
  steps.impulse = impulse_time / dt_;
  change_velocities(conditions_, time_, steps, body_, impulse_work_, impulses);
  add_mirror_impulses(mirror_forces_, impulse_time, impulses);
  take_reactions(impulses, impulse_time);
  const double part = impulse_time / static_cast<double>(load_times_.size());
  for (const double t : load_times_) add_work_of_forces(conditions_, t, part, body_, impulse_work_);
  add_work_of_friction(impulse_time);
  impulse_work_ = impulse_work_.split(mid_steps_);
  if (mid_steps_.before != 0.5) even_out();
}

// Whoever looks at the body takes the mean of both velocities for the one at the time of the forces: the one before
// becomes that of a step before as long as the one after.
void CentralDifference::even_out() {
  for_each_point(0, body_.owned(), [&](int i) {
    Vector& before = body_.previous_velocity[i];
    before = 2 * mid_steps_.velocity(before, body_.velocity[i]) - body_.velocity[i];
  });
}

// ω² of a sum of operators is at most the sum of theirs. A damping by the velocities of the mid-step before takes as
// much of the step as the formula of StepReport says.
double CentralDifference::critical_time_step() const {
  const double alone = critical_at_estimate_ * std::min(1.0, bound_at_estimate_ / frequency_bound_);
  const double undamped = alone / std::sqrt(1 + 0.25 * alone * alone * contact_.stiffness());
  return undamped * (std::sqrt(1 + damping_ * damping_) - damping_);
}

void CentralDifference::add_work_of_friction(double impulse_time) {
  const contact::FrictionWork work = contact_.friction_work(impulse_time, body_.previous_velocity, body_.velocity);
  impulse_work_.before.contact += work.before;
  impulse_work_.after.contact += work.after;
}

void CentralDifference::gather_reactions(int conditions) {
  reaction_forces_.assign(conditions, Vector::Zero());
  substep_impulses_ = ReactionImpulses(conditions);
}

// The images of points act on the body as bonds do, without work.
void CentralDifference::add_mirror_impulses(const std::vector<Vector>& forces, double impulse_time,
                                            ReactionImpulses& impulses) const {
  for (std::size_t m = 0; m < forces.size(); ++m) {
    impulses.add(body_.domain.mirrors[m].number, impulse_time * forces[m]);
  }
}

// What a substep gives belongs to the step before this impulse.
void CentralDifference::take_reactions(const ReactionImpulses& now, double impulse_time) {
  const double before = mid_steps_.before;
  impulses_ = {before * impulse_time, (1 - before) * impulse_time, substep_impulses_.sums(), now.sums()};
  for (std::size_t c = 0; c < reaction_forces_.size(); ++c) {
    impulses_.conditions_before[c] += before * now.sums()[c];
    impulses_.conditions_after[c] *= 1 - before;
    reaction_forces_[c] = now.sums()[c] / impulse_time;
    if (steps_ > 0) reaction_forces_[c] += substep_impulses_.sums()[c] / previous_dt_;
  }
  substep_impulses_ = ReactionImpulses(static_cast<int>(reaction_forces_.size()));
}

Reactions CentralDifference::reactions() const {
  Reactions all{reaction_forces_};
  if (!all.forces.empty()) body_.domain.communicator.sum(std::span(all.forces[0].data(), 3 * all.forces.size()));
  return all;
}

// Between time() and the next: the impulses of the points of higher time-step levels. Times of level m come every
// dt/2^m.
StepReport CentralDifference::substeps() {
  StepReport first;
  const int levels = multi_stepping_.level_count();
  if (levels == 0) return first;
  static Teuchos::Time& timer = phase("Substeps");
  const Timed timed(timer);
  const int count = 1 << levels;
  for (int n = 1; n < count; ++n) {
    const int level = levels - std::countr_zero(static_cast<unsigned>(n));
    const StepReport report = substep(level, time_ + n * (dt_ / count));
    take_worse(report.failure, first.failure);
  }
  return first;
}

StepReport CentralDifference::substep(int level, double t) {
  const PointTimeSteps steps = point_steps();
  const std::vector<int>& moved = multi_stepping_.moved(level);
  const int count = static_cast<int>(moved.size());
  for_each_point(0, count, [&](int n) { move(moved[n], steps); });
  const double impulse_time = std::ldexp(dt_, -level);
  const StepReport report = multi_stepping_.forces(body_, level, impulse_time);
  for_each_point(0, count, [&](int n) { apply_force(moved[n], impulse_time); });
  add_mirror_impulses(mirror_forces(body_, level, &moved), impulse_time, substep_impulses_);
  ImpulseWork work;
  change_velocities(conditions_of_level_[level - 1], t, steps, body_, work, substep_impulses_);
  work_ = work_ + work.before + work.after;
  return report;
}

void CentralDifference::move(int i, const PointTimeSteps& steps) {
  body_.domain.sites[i].current.head<3>() += steps.of(i) * body_.velocity[i].array();
}

void CentralDifference::advance_position(bool with_diagnostics) {
  update_rigid_motion(body_);
  if (body_.fracture) body_.fracture->start_step(body_, body_.velocity, dt_);
  const StepReport between = substeps();
  move_points();
  StepReport report = advance_stress(body_, dt_, with_diagnostics, time_);
  take_worse(between.failure, report.failure);
  if (levels_due_) reassign_levels(report, pushed(body_.velocity, dt_));
  sum_forces(body_, with_diagnostics);
  mirror_forces_ = mirror_forces(body_);
  contact_.add_forces(kinematics(), dt_, body_.force_density);
  check(report);
}

// To the end of the step.
void CentralDifference::move_points() {
  static Teuchos::Time& timer = phase("Motion and conditions");
  const Timed timed(timer);
  const PointTimeSteps steps = point_steps();
  for_each_point(0, body_.owned(), [&](int i) { move(i, steps); });
  time_ = next_time_;
  ++steps_;
  ++steps_since_estimate_;
  updates_ += multi_stepping_.updates_a_point();
  most_substeps_ = std::max(most_substeps_, 1 << multi_stepping_.level_count());
}

// One reduction a step: whether a point failed anywhere, whether to stop, how far the deformation has gone, and what
// contact needs.
void CentralDifference::check(const StepReport& report) {
  const std::string no_number = conditions_.first_not_finite();
  std::vector<double> agreed{static_cast<double>(no_number.empty() ? severity(report) : fatal),
                             static_cast<double>(request_), report.frequency_bound, report.damping,
                             pushes_exposed_points() ? 1.0 : 0.0};
  const std::size_t own = agreed.size();
  contact_.append_to_agree(kinematics(), agreed);
  {
    static Teuchos::Time& timer = phase("Agreement of ranks");
    const Timed timed(timer);
    body_.domain.communicator.max(agreed);
  }
  agreed_request_ = static_cast<Request>(agreed[1]);
  request_ = Request::none;
  frequency_bound_ = agreed[2];
  damping_ = std::max(agreed[3], linear_viscosity(body_));
  exposed_are_pushed_ = agreed[4] > 0;
  contact_.take_agreed(std::span(agreed).subspan(own), dt_);
  const auto severity = static_cast<Severity>(agreed[0]);
  went_on_ = severity == passable;
  warning_.clear();
  if (severity == harmless) return;
  std::ostringstream text;
  if (!no_number.empty()) {
    text << no_number;
  } else if (report.failure) {
    text << "at t = " << time_ << " s, step " << steps_ << " of " << dt_ << " s: " << describe(*report.failure, body_);
  }
  if (!went_on_) raise_together(body_.domain.communicator, text.str());
  warning_ = text.str();
}

// A point that only is turned inside out has a place; others take their neighbors with them.
CentralDifference::Severity CentralDifference::severity(const StepReport& report) const {
  if (!report.failure) return harmless;
  return control_.continue_with_inverted && report.failure->kind == Failure::Kind::inverted ? passable : fatal;
}

void CentralDifference::serialize(Archive& archive) {
  strut::serialize(archive, body_);
  multi_stepping_.serialize(archive, body_);
  critical_time_step_.serialize(archive, body_);
  serialize_tools(archive, conditions_, body_.owned());
  archive.number("time", time_);
  archive.number("steps", steps_);
  archive.number("steps_since_estimate", steps_since_estimate_);
  archive.number("most_substeps", most_substeps_);
  archive.number("updates", updates_);
  archive.number("dt", dt_);
  archive.number("limit", critical_at_estimate_);
  archive.number("frequency_bound", frequency_bound_);
  archive.number("bound_at_estimate", bound_at_estimate_);
  archive.number("damping", damping_);
  archive.number("regroup_due", levels_due_);
  archive.number("estimate_due", estimate_due_);
  archive.number("levels_anew", levels_anew_);
  archive.number("exposed_are_pushed", exposed_are_pushed_);
  archive.number("least_chosen", least_chosen_);
  archive.number("bound_of_step", bound_of_step_);
  archive.number("step_of_bound", step_of_bound_);
  serialize_work(archive);
  contact_.serialize(archive, kinematics(), dt_);
  if (!archive.loading()) return;
  restrict_conditions();
  for (MaterialBlock& block : body_.blocks) {
    if (block.in_rigid_motion) block.rest_frequency_bound = largest_frequency_bound(body_, block);
  }
}

void CentralDifference::serialize_work(Archive& archive) {
  archive.number("put_in", initial_energy_);
  archive.number("largest_energy", largest_energy_);
  const auto serialize = [&archive](const std::string& when, Work& work) {
    archive.share("external_work" + when, work.external);
    archive.share("tool_work" + when, work.tools);
    archive.share("contact_work" + when, work.contact);
  };
  serialize("", work_);
  serialize("_before", impulse_work_.before);
  serialize("_after", impulse_work_.after);
  substep_impulses_.serialize(archive);
  mirror_forces_.resize(body_.domain.mirrors.size(), Vector::Zero());
  serialize_mirror_forces(archive, mirror_forces_);
}

namespace {

// What the body holds and has dissipated.
double held(const Ledger& now) {
  return now.kinetic + now.tool_kinetic + now.elastic + now.dissipated + now.stabilization + now.fracture;
}

}  // namespace

double CentralDifference::put_in(const Ledger& now) const {
  return initial_energy_ + now.tools + now.contact + now.external;
}

Ledger CentralDifference::ledger() {
  raise_together(body_.domain.communicator, conditions_.first_not_finite());
  Ledger now;
  now.time = time_;
  now.dt = dt_;
  const Work done = work_ + impulse_work_.before;
  double sums[8] = {0, done.contact - contact_.energy(), done.external, done.tools, 0, 0, 0, 0};
  for (int i = 0; i < body_.owned(); ++i) {
    const Vector &after = body_.velocity[i], now_here = 0.5 * (body_.previous_velocity[i] + after);
    sums[0] += 0.5 * body_.mass(i) * mid_steps_.conserved_square(now_here, after);
    for (int c = 0; c < 3; ++c) sums[4 + c] += body_.mass(i) * now_here[c];
    sums[7] += 0.5 * body_.mass(i) * after.squaredNorm();
  }
  body_.domain.communicator.sum(sums);
  // The conserved energy is a difference: of a body at rest that has just been struck nothing is left but its
  // round-off.
  constexpr double round_off_of_squares = 1e-9;
  largest_energy_ = std::max(largest_energy_, round_off_of_squares * sums[7]);
  const Energies stored = stored_energies(body_);
  now.kinetic = sums[0];
  now.tool_kinetic = kinetic_energy_of_tools(conditions_);
  now.contact = sums[1];
  now.external = sums[2];
  now.tools = sums[3];
  now.momentum = Vector(sums[4], sums[5], sums[6]);
  now.elastic = stored.elastic;
  now.dissipated = stored.dissipated;
  now.stabilization = stored.stabilization;
  now.fracture = stored.fracture;
  now.heat = stored.heat;
  now.balance(held(now), put_in(now), largest_energy_);
  return now;
}

}  // namespace strut
