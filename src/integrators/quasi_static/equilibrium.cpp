#include "integrators/quasi_static/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/timing.hpp"
#include "integrators/ledger.hpp"
#include "integrators/quasi_static/turn.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/mirror_forces.hpp"
#include "mechanics/serialize.hpp"

namespace strut {

namespace {

// Factor on the forces by round-off: a body that moves a little has larger ones than a body at rest.
constexpr double few = 4;

// Ratios of the forces of a body at rest to the forces by round-off of positions: usual with quadratic correspondence,
// whose terms cancel; and largest by round-off: beyond it the body was handed over strained.
constexpr double usual_cancelled = 200, most_cancelled = 1e4;

// Root of the sum of squares over the points of each piece, N: positions have the error ε |X|, forces ω² m times that.
std::vector<double> round_off_of_places(const Body& body, const SeparateParts& parts) {
  std::vector<double> sums(parts.pieces(), 0);
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const int i = block.points[k];
      const double omega = frequency_bound(body, block, static_cast<int>(k));
      sums[parts.piece_of(i)] +=
          std::pow(omega * omega * body.mass(i) * body.domain.reference(i).cwiseAbs().maxCoeff(), 2);
    }
  }
  body.domain.communicator.sum(sums);
  for (double& sum : sums) sum = std::numeric_limits<double>::epsilon() * std::sqrt(sum);
  return sums;
}

// N, of all owned points.
Field forces_on_points(const Body& body) {
  Field forces(body.owned());
  for (int i = 0; i < body.owned(); ++i) forces[i] = body.domain.volume(i) * body.force_density[i];
  return forces;
}

// Root of the sum of squares over the points of each piece, N: the forces that are left in a body at rest.
std::vector<double> forces_at_rest(Body& body, const SeparateParts& parts) {
  const std::vector<HeatedPoints> heated = std::exchange(body.heated, {});  // at one temperature
  advance_by_any_step(body, 1, 0, false);  // any length: laws in rate form see nothing in a step of no length
  body.heated = heated;
  return parts.norms(forces_on_points(body), body.domain.communicator);
}

// For each body, points with the forces by which conditions hold them, from all that act on them. Bodies turn each by
// itself.
std::vector<std::vector<HeldPoint>> held_points(const Body& body, const Constraints& constraints,
                                                const Committed& start, const Field& before, const Field& after) {
  std::vector<std::vector<HeldPoint>> points(body.domain.body_count());
  for (int i = 0; i < body.owned(); ++i) {
    const Tensor held = Tensor::Identity() - constraints.free_projection(i);
    if (held.squaredNorm() < 0.5) continue;  // 1, 2 or 3 where it is held
    points[body.domain.body_of(i)].push_back({start.position(i), body.current(i), -held * before[i], -held * after[i]});
  }
  return points;
}

}  // namespace

Equilibrium::Equilibrium(Body& body, Conditions conditions, contact::Contact contact, std::optional<Fracture> fracture,
                         const Tolerance& tolerance)
    : body_(body),
      conditions_(std::move(conditions)),
      contact_(std::move(contact)),
      fracture_(std::move(fracture)),
      tolerance_(tolerance),
      parts_(body.domain),
      tools_(tools_of(conditions_), body),
      committed_(body) {
  check_equilibria_possible(conditions_);
  breaks_ = may_break();
  for (const MaterialBlock& block : body.blocks) {
    const auto* law = std::get_if<materials::Brittle>(&block.material.law);
    strengths_.push_back(law ? law->strength : 0);
  }
  if (fracture_) set_strengths(HUGE_VAL);
  residual_.assign(body.owned(), Vector::Zero());
  mirror_forces_before_.assign(side_count(body.domain), Vector::Zero());
  inner_ = outer_ = outer_before_ = forces_before_ = residual_;
  directions_ = body.domain.sites;
  last_scale_.assign(parts_.pieces(), 0);
  largest_scale_ = expansion_scale_ = first_residual_ = last_scale_;
  const std::vector<double> of_places = round_off_of_places(body, parts_);
  const Field of_body = body.force_density;  // of a run that goes on
  round_off_ = forces_at_rest(body, parts_);
  for (std::size_t p = 0; p < round_off_.size(); ++p) {
    const double of_rest = std::max(round_off_[p], of_places[p]);
    round_off_[p] = few * (of_rest > most_cancelled * of_places[p] ? usual_cancelled * of_places[p] : of_rest);
  }
  put_back(of_body, body);
  committed_.restore(body);
  positions_of_contact_.resize(body.owned());
  for (int i = 0; i < body.owned(); ++i) positions_of_contact_[i] = body.current(i);
}

void Equilibrium::begin(double t, double dt) {
  t_ = t, dt_ = dt;
  left_.clear();
  parts_.separate();
  begins_ = true;
  body_.domain.stretch_sides(t + dt);
  constraints_.emplace(held_directions(conditions_, body_, t, dt), body_);
  tools_.begin(body_, t, dt);
  if (fracture_) fracture_->start_criteria(body_);
  if (body_.heated.empty()) {
    std::ranges::fill(expansion_scale_, 0);
  } else {
    expansion_scale_ = forces_of_expansion();
  }
  check_values();
}

// Root of the sum of squares over the points of each piece, N: by the expansion of this step while the points stay. A
// free body has no other forces.
std::vector<double> Equilibrium::forces_of_expansion() {
  advance(0, t_, false);
  Field forces = body_.force_density;
  committed_.restore_materials(body_);
  advance(dt_, t_ + dt_, false);
  for (int i = 0; i < body_.owned(); ++i) forces[i] = body_.domain.volume(i) * (body_.force_density[i] - forces[i]);
  committed_.restore_materials(body_);
  return parts_.norms(forces, body_.domain.communicator);
}

void Equilibrium::follow_sides() {
  const Vector more = stretch_at(body_.domain.periods, t_ + dt_) - stretch_at(body_.domain.periods, t_);
  for (int i = 0; i < body_.owned(); ++i) {
    body_.domain.sites[i].current.head<3>() += more.array() * body_.domain.sites[i].reference.head<3>();
  }
}

// Checks the values of conditions at the end of the step, before any point is moved by them.
void Equilibrium::check_values() {
  const std::vector<Vector> kept = body_.force_density;
  add_forces(conditions_, t_ + dt_, 1, body_);
  put_back(kept, body_);
  raise_first(body_.domain.communicator, conditions_.first_not_finite());
}

Imbalance Equilibrium::evaluate(bool with_diagnostics) {
  static Teuchos::Time& timer = phase("Trials");
  const Timed timed(timer);
  committed_.restore_materials(body_);
  const StepReport report = advance(dt_, t_ + dt_, with_diagnostics);
  failure_ = report.failure;
  residual_ = body_.force_density;
  inner_ = forces_on_points(body_);
  take_side_forces();
  add_forces(conditions_, t_ + dt_, 1, body_);
  for (int i = 0; i < body_.owned(); ++i) outer_[i] = body_.domain.volume(i) * (body_.force_density[i] - residual_[i]);
  add_contact();
  add_contact_through_sides();
  if (contact_.any() && parts_.several()) parts_.join(contact_, body_.domain.communicator);
  forces_ = forces_on_points(body_);
  return measure(report.failure.has_value());
}

// Contact needs velocities to bound motion: it gets the displacements since the last trial, over one second.
void Equilibrium::add_contact() {
  if (!contact_.any()) return;
  std::vector<Vector> displacement(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) {
    displacement[i] = body_.current(i) - positions_of_contact_[i];
    positions_of_contact_[i] += displacement[i];
  }
  const contact::Kinematics kinematics{body_.domain, displacement, body_.density};
  std::vector<double> agreed;
  contact_.append_to_agree(kinematics, agreed);
  body_.domain.communicator.max(agreed);
  contact_.take_agreed(agreed, 1);
  contact_.add_trial_forces(kinematics, step_displacement(), body_.force_density);
}

void Equilibrium::begin_strained(double t) {
  const std::vector<double> of_places = round_off_of_places(body_, parts_);
  for (std::size_t p = 0; p < round_off_.size(); ++p) {
    round_off_[p] = std::min(round_off_[p], few * usual_cancelled * of_places[p]);  // however little is strained
  }
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
  add_forces(conditions_, t, 1, body_);
  forces_before_ = forces_ = forces_on_points(body_);
}

std::vector<Vector> Equilibrium::step_displacement() const {
  std::vector<Vector> displacement(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) displacement[i] = body_.current(i) - committed_.position(i);
  return displacement;
}

double Equilibrium::friction_work() const {
  return contact_.any() ? contact_.friction_work_of_trial(step_displacement()) : 0;
}

bool Equilibrium::needs_round() const {
  const Communicator& ranks = body_.domain.communicator;
  std::vector<double> pressures = tools_.largest_pressures(parts_);
  ranks.max(pressures);
  return ranks.max(tools_.violation(pressures, parts_)) > 1;
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
  for (std::size_t p = 0; p < largest_scale_.size(); ++p) {
    largest_scale_[p] = std::max(largest_scale_[p], last_scale_[p]);
  }
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

std::vector<Tensor> Equilibrium::contact_springs() {
  std::vector<Tensor> springs(body_.owned(), Tensor::Zero());
  contact_.add_springs(springs);
  tools_.add_springs(springs);
  return springs;
}

void Equilibrium::go_back() {
  committed_.restore(body_);
  body_.domain.stretch_sides(t_);
  advance(0, t_, true);
  add_forces(conditions_, t_, 1, body_);
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
  archive.points("all points", owned_ids(body_));
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
  serialize_of_pieces(archive, "largest_scale", largest_scale_);
  serialize_of_pieces(archive, "round_off", round_off_);  // of where the run began, not of the mesh
  const contact::Kinematics kinematics{body_.domain, body_.velocity, body_.density};
  contact_.serialize(archive, kinematics, 0);
  tools_.serialize(archive, body_);
  if (!archive.loading()) return;
  mirror_forces_before_ = mirror_forces_;
  forces_before_ = forces_;
  outer_ = outer_before_;
  for (int i = 0; i < body_.owned(); ++i) positions_of_contact_[i] = body_.current(i);
  committed_.take(body_);
  if (dt_ > 0) constraints_.emplace(held_directions(conditions_, body_, t_, dt_), body_);  // for reactions
}

// By points, as bonds may have broken since, by which pieces then have other numbers.
void Equilibrium::serialize_of_pieces(Archive& archive, const std::string& name, std::vector<double>& of_pieces) {
  std::vector<double> of_points(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) of_points[i] = of_pieces[parts_.piece_of(i)];
  archive.field(name, 1, [&](std::size_t i, int) -> double& { return of_points[i]; });
  if (!archive.loading()) return;
  std::ranges::fill(of_pieces, 0);
  for (int i = 0; i < body_.owned(); ++i) {
    double& one = of_pieces[parts_.piece_of(i)];
    one = std::max(one, of_points[i]);
  }
  body_.domain.communicator.max(of_pieces);
}

double Equilibrium::external_work() const {
  double sum = period_work(body_.domain, mirror_forces_before_, mirror_forces_, t_, dt_);
  for (const auto& held : held_points(body_, *constraints_, committed_, forces_before_, forces_)) {
    sum += work_beyond_chords(held, body_.domain.communicator);
  }
  for (int i = 0; i < body_.owned(); ++i) {
    sum += 0.5 * (outer_before_[i] + outer_[i]).dot(body_.current(i) - committed_.position(i));
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

std::string Equilibrium::weakest_point(const Imbalance& last) const {
  const Communicator& ranks = body_.domain.communicator;
  const auto [deepest, overlap] = tools_.deepest();
  const double most = ranks.max(overlap);
  if (most > 0 && is_balanced(last, tolerance_)) {  // the rounds of the multipliers did not end
    if (overlap != most) return "";
    return text_of(
        "forces are balanced, but a tool overlaps by ", overlap, " m with ", locate(body_, deepest),
        "; if a condition holds it there, expected a Node Set of the tool without it, else shorter load steps");
  }
  double largest = 0;
  int worst = -1;
  for (int i = 0; i < body_.owned(); ++i) {
    if (residual_[i].norm() > largest || worst < 0) largest = residual_[i].norm(), worst = i;
  }
  // A failure counts more than any force.
  const double rating = failure_ ? HUGE_VAL : largest;
  if (rating != ranks.max(rating) || worst < 0) return "";
  return failure_ ? describe(*failure_, body_)
                  : text_of("the largest force that is left, ", largest, " N, is at ", locate(body_, worst));
}

}  // namespace strut
