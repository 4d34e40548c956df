// strut --check: predicts what a run would do, from a real set-up and a few real steps that are discarded.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <variant>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "checkpoint/checkpoint.hpp"
#include "deck/deck.hpp"
#include "output/variables.hpp"
#include "run/input.hpp"
#include "run/report.hpp"
#include "run/simulation.hpp"
#include "run/start_from.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Wall time of a step, s, the least of a few: in others the critical time step is estimated anew, or cells that begin
// to flow are refitted, which is rare in a run.
double measured_step(const deck::Deck& deck, CentralDifference& solver) {
  constexpr int trial_steps = 5;
  double least = std::numeric_limits<double>::infinity();
  for (int steps = 0; steps < trial_steps && solver.time() < deck.solver.final_time; ++steps) {
    const auto start = Clock::now();
    solver.advance_velocity(deck.solver.final_time);
    solver.advance_position(false);
    least = std::min(least, seconds_since(start));
  }
  return std::isfinite(least) ? least : 0;
}

// Gives points relative velocities that strain them by about 1 % per step, so that metals flow and contact searches; if
// bonds may break, so little that none does.
void shake(Body& body, double dt) {
  const double part = body.may_break() ? 1e-6 : 1e-2;  // of a spacing, per step
  for (int i = 0; i < body.owned(); ++i) {
    const auto id = static_cast<double>(body.domain.id(i));
    const Vector direction(std::sin(12.9898 * id), std::sin(78.233 * id), std::sin(37.719 * id));
    body.velocity[i] += part * body.domain.cloud.spacings[i] / dt * direction;
  }
}

// Wall time of a step in which all points deform, s: in the first steps of a run bodies may be in rigid motion, which
// costs nothing. 0 if the imposed velocities make points fail.
double measured_moving_step(const deck::Deck& deck, CentralDifference& solver, Body& body) {
  try {
    shake(body, solver.dt());
    solver.advance_velocity(deck.solver.final_time);
    solver.advance_position(false);
    return measured_step(deck, solver);
  } catch (const Error&) {  // the shaking made points fail
    return 0;
  }
}

std::string range(double least, double most) { return as_duration(least) + " to " + as_duration(most); }

// `state`: of the run from which this one starts, or null.
std::string check_steps(const deck::Deck& deck, Scene& scene, StartState* state = nullptr) {
  constexpr double most = 2;  // factor if the step shrinks by deformation, points touch and are subcycled
  std::optional<CentralDifference> made;
  const auto make = [&](auto beginning) {
    made.emplace(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control, beginning,
                 std::move(scene.fracture));
  };
  const bool goes_on = state && state->goes_on();
  if (goes_on) {
    make(CentralDifference::ToBeRestored());
    state->go_on(*made);
  } else {
    make(deck.solver.initial_time);
  }
  CentralDifference& solver = *made;
  const std::string overlaps = state && !goes_on ? state->overlaps(solver.contact(), scene.body) : "";
  const double limit = solver.critical_time_step();
  check_step_at(deck.solver.initial_time, scene.control, limit);
  check_libraries(scene.body, scene.control, limit);
  const double first = measured_step(deck, solver);
  const double moving = std::max(first, measured_moving_step(deck, solver, scene.body));
  const double dt = scene.control.fixed_dt > 0 ? scene.control.fixed_dt : scene.control.safety_factor * limit;
  const double steps = std::ceil((deck.solver.final_time - deck.solver.initial_time) / dt);
  return text_of(overlaps, step_warning(scene.control, limit, deck.solver.initial_time), "critical time step ", limit,
                 " s at the start; about ", steps, " steps of ", dt,
                 " s (more where the step must shrink with the deformation)\n", "estimated time ",
                 range(steps * moving, most * steps * moving), " (", moving,
                 " s a step in which all points move, measured; ", first, " s of the first ones)\n");
}

// Prepares the explicit steps after equilibria. Motions and tools would tear a body of an earlier load step to where
// they have it at the end: then only the ends act, which take off inertia.
deck::Deck set_up_next(const deck::Deck& deck, QuasiStatic& solver, Scene& scene) {
  deck::Deck fitting = deck;
  const auto is_no_end = [](const deck::Condition& one) { return !std::holds_alternative<NonReflectingEnd>(one.kind); };
  if (solver.time() < deck.solver.final_time) std::erase_if(fitting.conditions, is_no_end);
  return set_up_next(fitting, solver.conditions(), solver.take_contact(), solver.take_fracture(), scene);
}

// Its time, too: load steps are shorter than the deck has them where no equilibrium was found.
std::string state_before_end(const QuasiStatic& solver, int made, double steps) {
  return text_of("the first ", made, " of ", steps, " load steps, t = ", solver.time(),
                 " s (the step may shrink with the deformation of the others; of the conditions only ends act)");
}

// Estimates from the first two load steps, or from the start of the first if it takes long.
std::string check_equilibria(const deck::Deck& deck, Scene& scene, std::optional<StartState>& state) {
  constexpr double patience = 60;  // s
  constexpr double most = 2;       // load steps with flow and contact take this many times as long
  const auto start = Clock::now();
  Observer observer{[](const std::string&) {}, {}, [&] { return seconds_since(start) > patience; }};
  QuasiStatic solver(scene.body, std::move(scene.conditions), std::move(scene.contact), *scene.quasi_static,
                     deck.solver.initial_time, deck.solver.final_time, observer, std::move(scene.fracture));
  if (state) state->begin(solver);
  const double steps = scene.quasi_static->load_steps;
  const int before = solver.steps();  // of another run
  const bool found = solver.advance();
  const double first = seconds_since(start);
  std::ostringstream text;
  text << steps << " load steps; the first one ";
  if (!found) {
    text << "takes more than " << as_duration(first) << "\nestimated time more than " << as_duration(steps * first)
         << "\n";
    return text.str();
  }
  text << "took " << as_duration(first) << " and " << solver.iterations() << " iterations\n";
  double second = first;
  if (solver.time() < deck.solver.final_time) {
    solver.advance();  // or stops when the time is up: then it takes longer
    second = seconds_since(start) - first;
  }
  text << "estimated time " << range(steps * std::min(first, second), most * steps * std::max(first, second)) << "\n";
  if (deck.next_solver) {
    const std::string reached = solver.time() < deck.solver.final_time
                                    ? state_before_end(solver, solver.steps() - before, steps)
                                    : "these load steps";
    const deck::Deck next = set_up_next(deck, solver, scene);
    text << "Solver 2, with the body after " << reached << ":\n" << scene.warnings << check_steps(next, scene);
  }
  return text.str();
}

}  // namespace

void check(const std::filesystem::path& deck_file, const Communicator& communicator) {
  deck::Problems problems;
  const deck::Deck deck = deck::read(deck_file, communicator, problems);
  check_resumption(deck, checkpoint_exists(deck, communicator), true, problems);
  std::optional<StartState> state = start_state_of(deck, communicator, problems);
  Scene scene = set_up(deck, checked_mesh(deck, problems, communicator), communicator);
  const OutputVariables variables = output_variables_of(deck, scene.body, scene.contact);
  const std::string started = state ? state->restore(deck, scene) : "";
  const std::string scene_text = describe_scene(scene, advice(deck, scene)) + started;
  if (communicator.rank() == 0) std::cout << scene_text << std::flush;
  const std::string text = (scene.quasi_static ? check_equilibria(deck, scene, state)
                                               : check_steps(deck, scene, state ? &*state : nullptr)) +
                           memory_and_frame(scene, variables);
  if (communicator.rank() == 0) std::cout << text << deck_file.string() << ": no errors\n";
}

}  // namespace strut
