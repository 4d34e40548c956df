#include "integrators/quasi_static/quasi_static.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "mechanics/serialize.hpp"

namespace strut {

namespace {

constexpr double shortest = 1.0 / 1024;  // shortest load step that is tried, relative to the longest
constexpr double patience = 1.0 / 16;    // relative to the longest: below it, relaxation is tried from the step's start
constexpr int most_turns = 6;            // turns of relaxation and Newton if Newton stalls
constexpr int turn = 125;                // iterations of relaxation in each turn, per iteration of Newton in the deck
constexpr int most_rounds = 30;          // of the multipliers of tools, per step
constexpr int easily = 6;                // iterations of Newton per round up to which the next step may be longer
constexpr double growth = 2;             // of the next step, at most
constexpr double round_off = 1e-9;

// A load step is shortened if it stretches a bond to more than the first, times its critical stretch, or loads a cell
// to more than the second, times its strength, because either then gives way with too much energy; but not below
// finest_break of the longest step: a crack may run in any step.
constexpr double most_stretch = 1.02, most_load = 1.1, finest_break = 1.0 / 16;

// The balance error is relative to an energy of at least this multiple of the work of errors: a body that is only
// carried along, or only expands, has no larger energy. Users get a warning from an error of 1 % on.
constexpr double above_errors = 100;

// Memory per point: 4.8 kB of GMRES vectors, 0.6 kB of the tangent, the rest of the near matrix and its hierarchy.
// Measured: 222 MiB between bodies of 729 and 13,824 points. The factors of thin bodies are not included.
constexpr double newton_bytes = 17e3;

}  // namespace

QuasiStatic::QuasiStatic(Body& body, Conditions conditions, contact::Contact contact, QuasiStaticControl control,
                         double initial_time, double final_time, Observer observer, std::optional<Fracture> fracture)
    : observer_(std::move(observer)),
      equilibrium_(body, std::move(conditions), std::move(contact), std::move(fracture), control.tolerance),
      newton_(equilibrium_, observer_),
      relaxation_(equilibrium_, observer_),
      control_(control),
      time_(initial_time),
      final_time_(final_time),
      longest_((final_time - initial_time) / control.load_steps),
      dt_(longest_),
      largest_energy_(energy_of_round_off(body)) {}

double QuasiStatic::bytes(const Body& body, const QuasiStaticControl& control) {
  const double committed = 400.0 * body.owned();  // includes forces and trials of contact
  if (!control.with_tangent) return committed + CriticalTimeStep::bytes(body);
  return committed + newton_bytes * body.owned() + TangentFactor(body).bytes();
}

// Extrapolates: points that moved in the last step continue at their rate, except in a step far longer than the last,
// such as the first one of a run that starts from another run's short steps.
void QuasiStatic::extrapolate() {
  const double factor = last_dt_ > 0 ? dt_ / last_dt_ : growth + 1;
  if (factor > growth) return equilibrium_.follow_sides();
  move_by(equilibrium_.body(), factor, last_step_);
}

EquilibriumSearch QuasiStatic::search_from_start(bool with_tangent) {
  equilibrium_.begin(time_, dt_);
  extrapolate();
  return search_in_rounds(with_tangent);
}

// Rounds of the multipliers of tools, each from the equilibrium of the previous one.
EquilibriumSearch QuasiStatic::search_in_rounds(bool with_tangent) {
  newton_.begin_anew();  // else a resumed run would not continue like an uninterrupted one
  relaxation_.begin_anew();
  EquilibriumSearch whole;
  for (int round = 0; round < most_rounds; ++round) {
    const EquilibriumSearch last = search(with_tangent);
    whole = {last.converged,
             whole.iterations + last.iterations,
             whole.evaluations + last.evaluations,
             last.left,
             last.interrupted,
             round + 1};
    if (!last.converged || !equilibrium_.needs_round()) return whole;
    equilibrium_.augment();
  }
  whole.converged = false;
  return whole;
}

// Where Newton stalls, the body is about to jump, fold or crush in layers: relaxation continues from there, through
// states without a useful tangent, and Newton finishes the search.
EquilibriumSearch QuasiStatic::search(bool with_tangent) {
  const Tolerance& tolerance = control_.tolerance;
  EquilibriumSearch found =
      with_tangent ? newton_.solve(tolerance) : relaxation_.solve(tolerance, Relaxation::most(tolerance));
  const auto goes_on = [&] { return with_tangent && !found.converged && !found.interrupted && !found.left.failed; };
  const auto add = [&](EquilibriumSearch more) {
    more.iterations += found.iterations, more.evaluations += found.evaluations;
    found = more;
  };
  for (int n = 0; n < most_turns && goes_on(); ++n) {
    add(relaxation_.solve(tolerance, turn * tolerance.most_iterations));
    if (goes_on()) add(newton_.solve(tolerance));
  }
  iterations_ += found.iterations;
  evaluations_ += found.evaluations;
  return found;
}

// If Newton inverted points, its state is useless: relaxation is tried from the start, but because it takes many times
// as long as Newton, only for steps that cutting has not solved.
EquilibriumSearch QuasiStatic::attempt() {
  const EquilibriumSearch search = search_from_start(control_.with_tangent);
  if (!search.left.failed || search.interrupted || !control_.with_tangent || dt_ > patience * longest_) return search;
  equilibrium_.go_back();
  return search_from_start(false);
}

void QuasiStatic::serialize(Archive& archive) {
  equilibrium_.serialize(archive);
  serialize_steps(archive);
}

void QuasiStatic::serialize_search(Archive& archive) {
  equilibrium_.serialize_search(archive);
  serialize_steps(archive);
}

void QuasiStatic::serialize_steps(Archive& archive) {
  newton_.serialize(archive);
  Body& body = equilibrium_.body();
  archive.points("motion", owned_ids(body));
  last_step_.resize(body.owned(), Vector::Zero());
  archive.field("last_step", 3, [this](std::size_t i, int c) -> double& { return last_step_[i][c]; });
  archive.number("time", time_);
  archive.number("dt", dt_);
  archive.number("last_dt", last_dt_);
  archive.number("steps", steps_);
  archive.number("put_in", put_in_);
  archive.number("external_work", external_);
  archive.number("work_of_tools", by_tools_);
  archive.number("work_of_friction", by_friction_);
  archive.number("lost_in_jumps", in_jumps_);
  archive.number("missed_plastic_work", missed_);
  archive.number("largest_energy", largest_energy_);
}

void QuasiStatic::begin_strained(bool goes_on) {
  if (!goes_on) equilibrium_.begin_strained(time_);
  dt_ = longest_;
  external_ -= equilibrium_.body().domain.communicator.sum(work_of_expansion(equilibrium_.body()));  // of that run
  put_in_ += ledger().gained;
}

bool QuasiStatic::advance() {
  dt_ = std::min({dt_, longest_, final_time_ - time_});
  for (;;) {
    const EquilibriumSearch search = attempt();
    const auto is_far_beyond = [this] {
      return equilibrium_.largest_stretch() > most_stretch || equilibrium_.largest_load() > most_load;
    };
    if (search.converged && (dt_ <= finest_break * longest_ || !is_far_beyond())) {
      commit(search);
      return true;
    }
    const std::string where = search.converged ? "" : equilibrium_.weakest_point(search.left);
    equilibrium_.go_back();
    if (search.interrupted) return false;
    dt_ *= 0.5;
    if (dt_ < shortest * longest_) {
      raise_together(equilibrium_.body().domain.communicator,
                     where.empty() ? ""
                                   : text_of("no equilibrium after t = ", time_, " s, by load steps down to ", 2 * dt_,
                                             " s: ", where));
    }
  }
}

// The work of the last trial, by the mean of the forces at both ends.
void QuasiStatic::take_work() {
  const Communicator& ranks = equilibrium_.body().domain.communicator;
  external_ += ranks.sum(equilibrium_.external_work());
  by_tools_ += ranks.sum(equilibrium_.tool_work());
  by_friction_ += ranks.sum(equilibrium_.friction_work());
  missed_ += ranks.sum(equilibrium_.missed_plastic_work());
  largest_energy_ += above_errors * equilibrium_.work_of_errors();
}

void QuasiStatic::commit(EquilibriumSearch search) {
  Body& body = equilibrium_.body();
  equilibrium_.evaluate(true);
  take_work();
  last_step_.resize(body.owned());
  for (int i = 0; i < body.owned(); ++i) {
    last_step_[i] = body.current(i) - equilibrium_.start(i);
    body.velocity[i] = body.previous_velocity[i] = last_step_[i] / dt_;
  }
  equilibrium_.commit();
  const bool was_easy = search.iterations <= easily * search.rounds;
  const std::int64_t broken = settle(search);
  last_dt_ = dt_;
  ++steps_;
  const double left = final_time_ - time_ - dt_;
  time_ = left > round_off * longest_ ? time_ + dt_ : final_time_;
  report(search, broken);
  if (!control_.with_tangent || was_easy) dt_ = std::min(growth * dt_, longest_);
}

namespace {

// While it lives, nobody asks a search to stop.
class Uninterrupted {
 public:
  explicit Uninterrupted(Observer& observer)
      : observer_(observer), before_(std::exchange(observer.stop_requested, [] { return false; })) {}
  Uninterrupted(const Uninterrupted&) = delete;
  ~Uninterrupted() { observer_.stop_requested = std::move(before_); }

 private:
  Observer& observer_;
  std::function<bool()> before_;
};

}  // namespace

// Breaks all bonds that are beyond their limit at once and softens cells, while conditions rest, and searches for the
// next equilibrium; repeats this as long as any gives way there. Returns the number of broken bonds. A stop request
// waits: a checkpoint between these equilibria could not be continued.
std::int64_t QuasiStatic::settle(EquilibriumSearch& search) {
  const Uninterrupted until_it_rests(observer_);
  std::int64_t all = 0;
  for (GaveWay now = equilibrium_.give_way(); now.any(); now = equilibrium_.give_way()) {
    all += now.bonds;
    const EquilibriumSearch found = search_in_rounds(control_.with_tangent);
    search.iterations += found.iterations, search.evaluations += found.evaluations, search.left = found.left;
    if (!found.converged) raise_no_equilibrium(found.left, all);
    equilibrium_.evaluate(true);
    take_work();
    in_jumps_ += equilibrium_.body().domain.communicator.sum(equilibrium_.work_of_jump());
    equilibrium_.commit();
    if (now.bonds == 0 && found.iterations == 0) break;  // the cells lost less than the tolerance
  }
  return all;
}

void QuasiStatic::raise_no_equilibrium(const Imbalance& left, std::int64_t broken) {
  const std::string where = equilibrium_.weakest_point(left);
  time_ += dt_;  // of the frame and the row that show where the search has ended
  const std::string text =
      text_of("no equilibrium at t = ", time_, " s after ",
              broken > 0 ? std::to_string(broken) + " bonds broke" : "cells softened",
              ": the crack runs through, or a piece is held by nothing; expected a motion that holds both sides of it, "
              "shorter load steps, or explicit steps (Solver > Verlet): ");
  raise_together(equilibrium_.body().domain.communicator, where.empty() ? "" : text + where);
}

void QuasiStatic::report(const EquilibriumSearch& search, std::int64_t broken) const {
  char line[200];
  const int length =
      std::snprintf(line, sizeof line, "step %4d  t = %.6g s  dt = %.3g s  %2d iterations, %4d evaluations, ", steps_,
                    time_, last_dt_, search.iterations, search.evaluations);
  std::string text(line, length);
  const Imbalance& left = search.left;
  if (left.scale > left.round_off) {
    text.append(line, std::snprintf(line, sizeof line, "%.1e of the load left", left.norm / left.scale));
  } else {
    text += "no load";
  }
  if (broken > 0) text += ", " + std::to_string(broken) + " bonds broke";
  observer_.load_steps(text);
}

Ledger QuasiStatic::ledger() {
  const Body& body = equilibrium_.body();
  Ledger now{.time = time_, .dt = last_dt_};
  now.take(stored_energies(body));
  now.external = external_ + now.expansion;
  now.tools = by_tools_;
  const double in_contact = body.domain.communicator.sum(contact().energy());
  now.jumps = in_jumps_;
  now.contact = by_friction_ - in_contact;
  // The energy that contact stores counts with the others: where every point is prescribed it is all there is.
  now.balance(now.elastic + now.dissipated + now.stabilization + now.fracture + now.jumps + in_contact,
              put_in_ + now.external + now.tools + by_friction_, largest_energy_);
  return now;
}

}  // namespace strut
