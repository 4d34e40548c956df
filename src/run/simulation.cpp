#include "run/simulation.hpp"

#include <csignal>
#include <iostream>
#include <sstream>

#include "base/errors.hpp"
#include "deck/deck.hpp"
#include "output/variables.hpp"
#include "run/balance.hpp"
#include "run/input.hpp"
#include "run/repartition.hpp"
#include "run/run_control.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

using Clock = EarlyEnd::Clock;

// On the rank that has a message.
void tell(const std::string& line) { std::cout << line << std::endl; }

// Ignores errors of the action, so that the message of an earlier error stays the last one.
template <class Action>
void quietly(Action&& action) {
  try {
    action();
  } catch (const Error&) {
  }
}

// Writes the present fields when a run ends with an error: they show where.
void leave_frame(OutputWriters& writers, double time, const Body& body) {
  if (!writers.frames.is_open() || writers.frames.has(time)) return;
  quietly([&] { writers.frames.write(time, body); });
}

// The time loop: everything after set-up. Returns the final ledger.
Ledger step_through(const RunServices& services, const ExplicitRun& run, Balance& balance) {
  if (const auto ranks = balance.take_restored_ranks()) repartition(run, *ranks);
  CentralDifference& solver = *run.solver;  // stays at this address
  say(services.scene.body.domain.communicator, critical_time_step_line(solver.critical_time_step()));
  ExplicitRunControl control(services, solver);
  for (;;) {
    control.save(solver);
    if (!control.ends_here(solver) && !solver.went_on()) {  // the monitor must first report the point
      if (const auto ranks = balance.better_ranks(*run.scene, solver)) repartition(run, *ranks);
    }
    solver.advance_velocity(services.deck.solver.final_time);
    if (control.observe(solver)) break;
    const bool with_diagnostics = control.prepare_next(solver);
    solver.advance_position(with_diagnostics);
  }
  control.finish();
  return solver.ledger();
}

// The loop over load steps. Returns the final ledger.
Ledger load_through(const RunServices& services, QuasiStatic& solver) {
  const auto& [deck, scene, writers, checkpoint, monitor, early_end] = services;
  const int conditions = writers.history.has_reactions() ? static_cast<int>(deck.conditions.size()) : 0;
  const Communicator& ranks = scene.body.domain.communicator;
  const auto record = [&](bool last) {
    return writers.write(
        scene.body, solver, [&] { return solver.reactions(conditions); }, last);
  };
  bool ending = false, save = false;
  for (;;) {
    const bool over = solver.time() >= deck.solver.final_time, last = ending || over;
    if (over) save = checkpoint.due_at_the_end();
    if (save || checkpoint.due(solver.steps(), solver.time())) checkpoint.write(solver.steps(), solver.time());
    const auto ledger = record(last);
    monitor.check_energy(ledger ? *ledger : solver.ledger(), last);
    monitor.check_failed(solver.time());
    monitor.check_interpenetration(solver.time(), solver.contact());
    monitor.check_undeclared(solver.time(), solver.contact());
    monitor.check_tools(solver.time(), solver.conditions(), scene.tools);
    if (last) return solver.ledger();
    try {
      ending = !solver.advance();
    } catch (const Error&) {
      quietly([&] { record(true); });
      throw;
    }
    ending = ranks.max(ending || early_end.wanted() ? 1.0 : 0.0) > 0;
    save = ending || ranks.max(checkpoint.due_by_the_clock() ? 1.0 : 0.0) > 0;
  }
}

Observer observer(const deck::Deck& deck, const Communicator& communicator, const EarlyEnd& early_end) {
  const auto tell = [&communicator](const std::string& line) { say(communicator, line + "\n"); };
  Observer observer{tell, {}, [&early_end] { return early_end.wanted(); }};
  if (deck.solver.verbose) observer.iterations = tell;
  return observer;
}

// A run from set-up to the end, with a solver of either kind.
template <class Solver, class Through>
bool carry_out(const deck::Deck& deck, Scene& scene, OutputWriters& writers, Solver& solver, Balance& balance,
               Start start, Clock::time_point began, const EarlyEnd& early_end, const Through& through) {
  const Communicator communicator = scene.body.domain.communicator;
  Monitor monitor(deck.watch, deck.solver.final_time - deck.solver.initial_time, scene.body, tell);
  Checkpoint checkpoint(deck, communicator, [&](Archive& archive) {
    solver.serialize(archive);
    monitor.serialize(archive);
    balance.serialize(archive, scene.body);
    writers.serialize(archive, solver.time());
  });
  if (start == Start::continued && checkpoint_exists(deck, communicator)) {
    checkpoint.load();
  } else {
    checkpoint.remove();
  }
  writers.open(scene.body);
  const int before = solver.steps();
  catch_signals({SIGINT, SIGTERM, SIGHUP});
  const Ledger ledger = [&] {
    try {
      return through(RunServices{deck, scene, writers, checkpoint, monitor, early_end});
    } catch (const LostState& error) {
      throw Error(error.what() + checkpoint.hint());
    } catch (const Error& error) {
      leave_frame(writers, solver.time(), scene.body);
      throw Error(error.what() + checkpoint.hint());
    }
  }();
  const bool over = solver.time() >= deck.solver.final_time;
  if (over) checkpoint.close();
  const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
  say(communicator, closing_report(scene, solver, ledger, seconds, before));
  if (!over) say(communicator, early_end.reason(communicator) + checkpoint.hint() + "\n");
  return over;
}

// Checks, before the mesh is read, whether the run can resume from a checkpoint or start without it.
void look_at_checkpoint(const deck::Deck& deck, Start start, const Communicator& communicator,
                        deck::Problems& problems) {
  const bool is_there = checkpoint_exists(deck, communicator);
  check_resumption(deck, is_there, start == Start::anew, problems);
  if (!problems.empty()) return;
  if (is_there && start == Start::continued) check_changes(deck, communicator);
  if (!is_there && (start == Start::continued || deck.restart.resumes))
    say(communicator, "there is no checkpoint " + deck.restart.file.string() + ": the run begins anew\n");
}

// A run of explicit steps.
bool step(const deck::Deck& deck, std::optional<Scene>& parts, std::optional<OutputWriters>& writers, Start start,
          Clock::time_point began, const EarlyEnd& early_end) {
  Scene& scene = *parts;
  Balance balance(deck);
  std::optional<CentralDifference> solver;
  solver.emplace(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                 deck.solver.initial_time, std::move(scene.fracture));
  if (writers->history.has_reactions()) solver->gather_reactions(static_cast<int>(deck.conditions.size()));
  const ExplicitRun whole{deck, parts, solver, writers};
  return carry_out(deck, scene, *writers, *solver, balance, start, began, early_end,
                   [&](const RunServices& services) { return step_through(services, whole, balance); });
}

// Makes the writers of the next solver, which append to the files of the last one.
void hand_over(const deck::Deck& next, double time, const Scene& scene, std::optional<OutputWriters>& writers) {
  Snapshot kept;
  Archive saved = Archive::saving_to(kept);
  writers->serialize(saved, time);
  writers.reset();
  writers.emplace(next, output_variables_of(next, scene.body, scene.contact));
  Archive restored = Archive::loading_from(kept);
  writers->serialize(restored, time);
}

}  // namespace

bool run(const std::filesystem::path& deck_file, const Communicator& communicator, Start start) {
  const Clock::time_point began = Clock::now();
  forget_signals();
  // A job that is stopped while the mesh is read continues in the next one; other signals end it at once.
  catch_signals({SIGUSR1, SIGUSR2, SIGXCPU});
  deck::Problems problems;
  const deck::Deck deck = deck::read(deck_file, communicator, problems);
  const EarlyEnd early_end(began, deck.solver.wall_time);
  if (start == Start::continued && problems.empty() && !checkpoint_exists(deck, communicator) &&
      is_over(deck, communicator)) {
    say(communicator, deck.output.file.string() + " is of a run that is over: there is nothing to go on with\n");
    return true;
  }
  look_at_checkpoint(deck, start, communicator, problems);
  std::optional<Scene> parts = set_up(deck, checked_mesh(deck, std::move(problems), communicator), communicator);
  Scene& scene = *parts;  // stays at this address, also when another scene replaces it
  say(communicator, describe_scene(scene, advice(deck, scene)));
  std::optional<OutputWriters> writers;
  writers.emplace(deck,
                  output_variables_of(deck, scene.body, scene.contact));  // checks all names before a file is replaced
  if (!scene.quasi_static) return step(deck, parts, writers, start, began, early_end);
  Balance balance(deck);
  QuasiStatic solver(scene.body, std::move(scene.conditions), std::move(scene.contact), *scene.quasi_static,
                     deck.solver.initial_time, deck.solver.final_time, observer(deck, communicator, early_end),
                     std::move(scene.fracture));
  const bool over = carry_out(deck, scene, *writers, solver, balance, start, began, early_end,
                              [&](const RunServices& services) { return load_through(services, solver); });
  if (!over || !deck.next_solver) return over;
  const deck::Deck next = set_up_next(deck, solver.take_contact(), scene);
  std::ostringstream from;
  from << "\nSolver 2: explicit steps from t = " << next.solver.initial_time << " s\n" << scene.warnings;
  say(communicator, from.str());
  hand_over(next, solver.time(), scene, writers);
  return step(next, parts, writers, start, began, early_end);
}

}  // namespace strut
