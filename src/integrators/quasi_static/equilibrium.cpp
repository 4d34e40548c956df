#include "integrators/quasi_static/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "base/errors.hpp"
#include "base/timing.hpp"
#include "integrators/period_work.hpp"
#include "integrators/quasi_static/turn.hpp"
#include "mechanics/formulation/flow.hpp"
#include "mechanics/hindered_breaks.hpp"
#include "mechanics/mirror_forces.hpp"
#include "mechanics/serialize.hpp"

namespace strut {

namespace {

// Reactions below this fraction of the largest so far are no scale for the imbalance: the rest of an unloaded body is
// round-off of its loading.
constexpr double smallest_scale = 1e-4;

// Factor on the forces by round-off: a body that moves a little has larger ones than a body at rest.
constexpr double few = 4;

// Ratios of the forces of a body at rest to the forces by round-off of positions: usual with quadratic correspondence,
// whose terms cancel; and largest by round-off: beyond it the body was handed over strained.
constexpr double usual_cancelled = 200, most_cancelled = 1e4;

// Root of the sum of squares over all points, N: positions have the error ε |X|, forces ω² m times that.
double round_off_of_places(const Body& body) {
  double sum = 0;
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const int i = block.points[k];
      const double omega = frequency_bound(body, block, static_cast<int>(k));
      sum += std::pow(omega * omega * body.mass(i) * body.domain.reference(i).cwiseAbs().maxCoeff(), 2);
    }
  }
  return std::numeric_limits<double>::epsilon() * std::sqrt(body.domain.communicator.sum(sum));
}

// Root of the sum of squares over all points, N: the forces that are left in a body at rest.
double forces_at_rest(Body& body) {
  const std::vector<HeatedPoints> heated = std::exchange(body.heated, {});  // at one temperature
  advance_by_any_step(body, 1, 0, false);  // any length: laws in rate form see nothing in a step of no length
  body.heated = heated;
  double sum = 0;
  for (int i = 0; i < body.owned(); ++i) sum += (body.domain.volume(i) * body.force_density[i]).squaredNorm();
  return std::sqrt(body.domain.communicator.sum(sum));
}

// N². Forces through periodic sides count as loads that are spread over all points. Fewer points bear them, so this is
// a lower bound of the scale, and never hides an imbalance.
double square_of_side_forces(const Body& body, std::vector<Vector> forces) {
  if (body.domain.periods.empty()) return 0;
  const Communicator& ranks = body.domain.communicator;
  ranks.sum(std::span(forces.data()->data(), 3 * forces.size()));
  double sum = 0;
  for (const Vector& force : forces) sum += force.squaredNorm();
  return sum / static_cast<double>(ranks.sum(static_cast<std::int64_t>(body.owned())));
}

// Points with the forces by which conditions hold them, from all that act on them.
std::vector<HeldPoint> held_points(const Body& body, const Constraints& constraints, const Committed& start,
                                   const Field& before, const Field& after) {
  std::vector<HeldPoint> points;
  for (int i = 0; i < body.owned(); ++i) {
    const Tensor held = Tensor::Identity() - constraints.free_projection(i);
    if (held.squaredNorm() < 0.5) continue;  // 1, 2 or 3 where it is held
    points.push_back({start.place(i), body.current(i), -held * before[i], -held * after[i]});
  }
  return points;
}

// In place: arrays of Python are views of the values.
void put_back(const Field& force_density, Body& body) { std::ranges::copy(force_density, body.force_density.begin()); }

}  // namespace

Equilibrium::Equilibrium(Body& body, Conditions conditions, contact::Contact contact, std::optional<Fracture> fracture)
    : body_(body),
      conditions_(std::move(conditions)),
      contact_(std::move(contact)),
      fracture_(std::move(fracture)),
      tools_(tools_of(conditions_), body),
      committed_(body) {
  check_equilibria_possible(conditions_);
  breaks_ = may_break();
  strengths_.assign(body.blocks.size(), HUGE_VAL);
  if (fracture_) swap_strengths();
  residual_.assign(body.owned(), Vector::Zero());
  mirror_forces_before_.assign(side_count(body.domain), Vector::Zero());
  inner_ = outer_ = outer_before_ = forces_before_ = residual_;
  directions_ = body.domain.sites;
  const double of_places = round_off_of_places(body);
  const Field of_body = body.force_density;  // of a run that goes on
  const double of_rest = std::max(forces_at_rest(body), of_places);
  round_off_ = few * (of_rest > most_cancelled * of_places ? usual_cancelled * of_places : of_rest);
  put_back(of_body, body);
  committed_.restore(body);
  looked_at_.resize(body.owned());
  for (int i = 0; i < body.owned(); ++i) looked_at_[i] = body.current(i);
}

void Equilibrium::begin(double t, double dt) {
  t_ = t, dt_ = dt;
  left_.clear();
  stretch_sides(t + dt);
  constraints_.emplace(held_directions(conditions_, body_, t, dt), body_);
  tools_.begin(body_, t, dt);
  if (fracture_) fracture_->start_criteria(body_);
  expansion_scale_ = body_.heated.empty() ? 0 : force_of_expansion();
  check_values();
}

// Root of the sum of squares over all points, N, of the forces by the thermal expansion of this step with points at
// rest. A free body has no other forces.
double Equilibrium::force_of_expansion() {
  advance(0, t_, false);
  const std::vector<Vector> before = body_.force_density;
  committed_.restore_materials(body_);
  advance(dt_, t_ + dt_, false);
  double sum = 0;
  for (int i = 0; i < body_.owned(); ++i) {
    sum += (body_.domain.volume(i) * (body_.force_density[i] - before[i])).squaredNorm();
  }
  committed_.restore_materials(body_);
  return std::sqrt(body_.domain.communicator.sum(sum));
}

void Equilibrium::stretch_sides(double t) { body_.domain.halo.set_stretch(stretch_at(body_.domain.periods, t)); }

void Equilibrium::follow_sides() {
  const Vector more = stretch_at(body_.domain.periods, t_ + dt_) - stretch_at(body_.domain.periods, t_);
  for (int i = 0; i < body_.owned(); ++i) {
    body_.domain.sites[i].current.head<3>() += more.array() * body_.domain.sites[i].reference.head<3>();
  }
}

// Checks the values of conditions at the end of the step, before any point is moved by them.
void Equilibrium::check_values() {
  const std::vector<Vector> kept = body_.force_density;
  add_forces(conditions_, t_ + dt_, body_);
  put_back(kept, body_);
  raise_together(body_.domain.communicator, conditions_.first_not_finite());
}

Imbalance Equilibrium::evaluate(bool with_diagnostics) {
  static Teuchos::Time& timer = phase("Trials");
  const Timed timed(timer);
  committed_.restore_materials(body_);
  const StepReport report = advance(dt_, t_ + dt_, with_diagnostics);
  failure_ = report.failure;
  residual_ = body_.force_density;
  for (int i = 0; i < body_.owned(); ++i) inner_[i] = body_.domain.volume(i) * residual_[i];
  mirror_forces_ = mirror_forces(body_);
  add_forces(conditions_, t_ + dt_, body_);
  for (int i = 0; i < body_.owned(); ++i) outer_[i] = body_.domain.volume(i) * (body_.force_density[i] - residual_[i]);
  add_contact();
  contact_.add_mirror_reactions(body_.domain, mirror_forces_);
  forces_.resize(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) forces_[i] = body_.domain.volume(i) * body_.force_density[i];
  return measure(report.failure.has_value());
}

// Contact needs velocities to bound motion: it gets the displacements since the last trial, over one second.
void Equilibrium::add_contact() {
  if (!contact_.any()) return;
  std::vector<Vector> way(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) {
    way[i] = body_.current(i) - looked_at_[i];
    looked_at_[i] += way[i];
  }
  const contact::Kinematics kinematics{body_.domain, way, body_.density};
  std::vector<double> agreed;
  contact_.append_to_agree(kinematics, agreed);
  body_.domain.communicator.max(agreed);
  contact_.take_agreed(agreed, 1);
  contact_.add_trial_forces(kinematics, step_way(), body_.force_density);
}

void Equilibrium::begin_strained(double t) {
  round_off_ = std::min(round_off_, few * usual_cancelled * round_off_of_places(body_));  // however little is strained
  for (MaterialBlock& block : body_.blocks) block.in_rigid_motion = false;  // equilibria look at every body
  advance(0, t, true);
  mirror_forces_before_ = mirror_forces(body_);
  add_contact();
  contact_.commit();  // the friction that is there does work from now on
  contact_.add_mirror_reactions(body_.domain, mirror_forces_before_);
  mirror_forces_ = mirror_forces_before_;
  for (int i = 0; i < body_.owned(); ++i) outer_before_[i] = -body_.domain.volume(i) * body_.force_density[i];
  hold_at(t);
  const std::vector<PointExpansion> pulled = *body_.expansion;  // by the stress that is there
  committed_.restore_materials(body_);
  body_.expansion = pulled;
  committed_.take(body_);
}

// The forces on held points, for the reactions before the first step. Those of tools begin with it.
void Equilibrium::hold_at(double t) {
  constraints_.emplace(held_directions(conditions_, body_, t, 0), body_);
  add_forces(conditions_, t, body_);
  forces_.resize(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) forces_[i] = body_.domain.volume(i) * body_.force_density[i];
  forces_before_ = forces_;
}

std::vector<Vector> Equilibrium::step_way() const {
  std::vector<Vector> way(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) way[i] = body_.current(i) - committed_.place(i);
  return way;
}

double Equilibrium::friction_work() const { return contact_.any() ? contact_.friction_work_of_trial(step_way()) : 0; }

// Upper bound by Σ f·u ≤ ‖f‖ ‖u‖. A free body that expands has no forces but those that the search has left.
double Equilibrium::work_of_errors(double tolerance) const {
  double sum = 0;
  for (const Vector& way : step_way()) sum += way.squaredNorm();
  return (round_off_ + tolerance * expansion_scale_) * std::sqrt(body_.domain.communicator.sum(sum));
}

// The reactions balance the forces in held directions.
Imbalance Equilibrium::measure(bool failed) {
  Field of_tools(body_.owned(), Vector::Zero());
  tools_.add_forces(body_, of_tools);
  double sums[] = {0, 0, failed ? 1.0 : 0.0};
  for (int i = 0; i < body_.owned(); ++i) {
    forces_[i] += of_tools[i];
    residual_[i] = constraints_->free_projection(i) * forces_[i];
    outer_[i] -= forces_[i] - residual_[i];
    sums[0] += residual_[i].squaredNorm();
    sums[1] += (outer_[i] + of_tools[i]).squaredNorm();
  }
  body_.domain.communicator.sum(sums);
  const double of_sides = square_of_side_forces(body_, mirror_forces_);
  Imbalance now{std::sqrt(sums[0]), std::sqrt(sums[1] + of_sides + expansion_scale_ * expansion_scale_), round_off_,
                sums[2] > 0};
  if (!std::isfinite(now.norm + now.scale)) now.failed = true;
  last_scale_ = now.scale;
  now.scale = std::max(now.scale, smallest_scale * largest_scale_);
  return now;
}

bool Equilibrium::needs_round() const {
  const Communicator& ranks = body_.domain.communicator;
  return ranks.max(tools_.violation(ranks.max(tools_.largest_pressure()))) > 1;
}

bool Equilibrium::contact_has_changed() { return body_.domain.communicator.any(tools_.has_changed()); }

void Equilibrium::linearize() {
  static Teuchos::Time& timer = phase("Tangents");
  const Timed timed(timer);
  tangents_ = point_tangents(body_, committed_, dt_);
}

void Equilibrium::apply(const Field& field, Field& result) {
  static Teuchos::Time& timer = phase("Products");
  const Timed timed(timer);
  for (int i = 0; i < body_.owned(); ++i) directions_[i].current.head<3>() = field[i].array();
  apply_tangent(body_, body_.domain.halo, directions_, &tangents_, body_.force_states, result);
  for (int i = 0; i < body_.owned(); ++i) result[i] *= body_.domain.volume(i);
  contact_.add_stiffness(field, result);
  tools_.add_stiffness(field, result);
}

void Equilibrium::commit() {
  largest_scale_ = std::max(largest_scale_, last_scale_);
  contact_.commit();
  tools_.commit();
  outer_before_ = outer_;
  mirror_forces_before_ = mirror_forces_;
  forces_before_ = forces_;
  if (fracture_) fracture_->finish_criteria(body_);
  begin_flow_of_cells();
}

// Cells that begin to flow have other forces from here on. The difference, by which the body would jump to its next
// equilibrium, is held at first and fades over the next step; its work counts as that of loads.
void Equilibrium::begin_flow_of_cells() {
  const bool any = body_.domain.communicator.any(begin_flow(body_));
  committed_.take(body_);
  if (!any) return;
  const std::vector<Vector> kept = body_.force_density;
  advance(0, t_ + dt_, false);
  for (int i = 0; i < body_.owned(); ++i) {
    outer_before_[i] += inner_[i] - body_.domain.volume(i) * body_.force_density[i];
  }
  put_back(kept, body_);
  committed_.restore_materials(body_);
}

// The deck's check (deck/sections/combinations.cpp) refuses the others, unless explicit steps follow, in which they
// break.
bool Equilibrium::may_break() const {
  return fracture_ && hindrance_of_breaks(body_).empty() && !tools_.any() && !contact_.any();
}

// Damage that is held makes the search for an equilibrium an elastic one, and damage that grows between two of them
// dissipates what the body then no longer stores, however far a crack runs (docs/theory.md).
GaveWay Equilibrium::give_way() {
  if (!breaks_) return {};
  const std::int64_t before = broken_bonds(body_);
  const double spent = stored_energies(body_).fracture;
  fracture_->start_rest(body_);
  const Field inner = inner_, with_loads = body_.force_density;
  swap_strengths();
  advance(dt_, t_ + dt_, true);
  swap_strengths();
  const GaveWay gave{body_.domain.communicator.sum(broken_bonds(body_) - before) / 2,
                     stored_energies(body_).fracture > spent};
  if (!gave.any()) {
    committed_.restore_materials(body_);  // to the last bit, whether a checkpoint is written here or not
    put_back(with_loads, body_);
    return gave;
  }
  if (body_.domain.communicator.any(begin_flow(body_))) advance(0, t_ + dt_, true);
  left_.resize(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) left_[i] = inner[i] - body_.domain.volume(i) * body_.force_density[i];
  committed_.take(body_);
  constraints_.emplace(held_directions(conditions_, body_, t_ + dt_, 0), body_);
  return gave;
}

void Equilibrium::swap_strengths() {
  for (std::size_t b = 0; b < strengths_.size(); ++b) {
    auto* law = std::get_if<materials::Brittle>(&body_.blocks[b].material.law);
    if (law) std::swap(law->strength, strengths_[b]);
  }
}

std::optional<Fracture> Equilibrium::take_fracture() {
  if (fracture_) swap_strengths();
  return std::move(fracture_);
}

double Equilibrium::work_of_jump() const {
  double sum = 0;
  for (int i = 0; i < body_.owned(); ++i) sum -= 0.5 * left_[i].dot(body_.current(i) - committed_.place(i));
  return sum;
}

std::vector<Tensor> Equilibrium::contact_springs() {
  std::vector<Tensor> springs(body_.owned(), Tensor::Zero());
  contact_.add_springs(springs);
  tools_.add_springs(springs);
  return springs;
}

void Equilibrium::go_back() {
  committed_.restore(body_);
  stretch_sides(t_);
  advance(0, t_, true);
  add_forces(conditions_, t_, body_);
  add_contact();  // for its energy
  forces_ = forces_before_;
  outer_ = outer_before_;
  mirror_forces_ = mirror_forces_before_;
  tools_.go_back();
}

void Equilibrium::serialize(Archive& archive) {
  if (!archive.loading()) committed_.restore(body_);  // to the last bit, after a trial that was interrupted
  strut::serialize(archive, body_);
  if (fracture_) fracture_->serialize(archive, body_);
  serialize_search(archive);
}

void Equilibrium::serialize_search(Archive& archive) {
  archive.points("all points", {body_.domain.cloud.ids.begin(), body_.domain.cloud.ids.begin() + body_.owned()});
  const auto serialize_field = [&archive](const std::string& name, Field& field) {
    archive.field(name, 3, [&field](std::size_t i, int c) -> double& { return field[i][c]; });
  };
  serialize_tools(archive, conditions_, body_.owned());
  forces_.resize(body_.owned(), Vector::Zero());
  serialize_field("forces", forces_);
  serialize_field("outer_forces", outer_before_);
  mirror_forces_.resize(side_count(body_.domain), Vector::Zero());
  serialize_mirror_forces(archive, mirror_forces_);
  archive.number("step_begin", t_);
  archive.number("step_length", dt_);
  archive.number("largest_scale", largest_scale_);
  archive.number("round_off", round_off_);  // of where the run began, not of the mesh
  const contact::Kinematics kinematics{body_.domain, body_.velocity, body_.density};
  contact_.serialize(archive, kinematics, 0);
  tools_.serialize(archive, body_);
  if (!archive.loading()) return;
  mirror_forces_before_ = mirror_forces_;
  forces_before_ = forces_;
  outer_ = outer_before_;
  for (int i = 0; i < body_.owned(); ++i) looked_at_[i] = body_.current(i);
  committed_.take(body_);
  if (dt_ > 0) constraints_.emplace(held_directions(conditions_, body_, t_, dt_), body_);  // for reactions
}

double Equilibrium::external_work() const {
  double sum = period_work(body_.domain, mirror_forces_before_, mirror_forces_, t_, dt_);
  const std::vector<HeldPoint> held = held_points(body_, *constraints_, committed_, forces_before_, forces_);
  sum += work_beyond_chords(held, body_.domain.communicator);
  for (int i = 0; i < body_.owned(); ++i) {
    sum += 0.5 * (outer_before_[i] + outer_[i]).dot(body_.current(i) - committed_.place(i));
  }
  return sum;
}

Reactions Equilibrium::reactions(int conditions) const {
  Reactions all{std::vector<Vector>(conditions, Vector::Zero())};
  if (conditions == 0 || !constraints_) return all;
  constraints_->add_reactions(forces_, all.forces);
  tools_.add_reactions(all.forces);
  for (std::size_t m = 0; m < mirror_forces_.size(); ++m) {
    all.forces[number_of_side(body_.domain, m)] += mirror_forces_[m];
  }
  body_.domain.communicator.sum(std::span(all.forces.data()->data(), 3 * all.forces.size()));
  return all;
}

std::string Equilibrium::weakest_point() const {
  const Communicator& ranks = body_.domain.communicator;
  double largest = 0;
  int worst = -1;
  for (int i = 0; i < body_.owned(); ++i) {
    if (residual_[i].norm() > largest || worst < 0) largest = residual_[i].norm(), worst = i;
  }
  // A failure counts more than any force.
  const double rating = failure_ ? HUGE_VAL : largest;
  const double highest = ranks.max(rating);
  std::string text;
  if (rating == highest && worst >= 0) {
    std::ostringstream line;
    line << "the largest force that is left, " << largest << " N, is at " << locate(body_, worst);
    text = failure_ ? describe(*failure_, body_) : line.str();
  }
  return text;
}

}  // namespace strut
