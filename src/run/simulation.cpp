#include "run/simulation.hpp"

#include <chrono>
#include <csignal>
#include <iostream>

#include "base/errors.hpp"
#include "checkpoint/checkpoint.hpp"
#include "deck/deck.hpp"
#include "output/variables.hpp"
#include "output/writers.hpp"
#include "run/monitor.hpp"
#include "run/report.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t signalled = 0;

void catch_signals() {
  std::signal(SIGINT, [](int) { signalled = 1; });
  std::signal(SIGTERM, [](int) { signalled = 1; });
}

void say(const Communicator& communicator, const std::string& text) {
  if (communicator.rank() == 0) std::cout << text << std::flush;
}

// On the rank that has something to tell.
void tell(const std::string& line) { std::cout << line << std::endl; }

// After an error, which is what is told: not what goes wrong here.
template <class Action>
void quietly(Action&& action) {
  try {
    action();
  } catch (const Error&) {
  }
}

// The fields as they are, where a run ends in an error: they show where.
void leave_frame(OutputWriters& records, double time, const Body& body) {
  if (!records.frames.enabled() || records.frames.has(time)) return;
  quietly([&] { records.frames.write(time, body); });
}

// Everything after set-up: the loop over steps. Returns the ledger at the end.
Ledger step_through(const deck::Deck& deck, Scene& scene, CentralDifference& solver, OutputWriters& records,
                    Checkpoint& checkpoint, Monitor& watch) {
  using Request = CentralDifference::Request;
  const double final_time = deck.solver.final_time;
  const Body& body = scene.body;
  Progress progress(body.domain.communicator, deck.solver.initial_time, solver.time(), final_time);
  bool warned = false;
  // A step after the ranks agreed, so that energies are known everywhere at the times that are looked at or kept.
  bool ending = false, saving = false;
  for (;;) {
    const double now = solver.time();
    const bool over = now >= final_time, last = over || ending;
    const bool save = over ? checkpoint.due_at_the_end() : ending || saving;
    if (save || checkpoint.due(solver.steps(), now)) checkpoint.write(solver.steps(), now);
    solver.advance_velocity(final_time);
    if (!warned && scene.control.fixed_dt > solver.critical_time_step()) {
      say(body.domain.communicator, step_warning(scene.control, solver.critical_time_step(), now));
      warned = true;
    }
    watch.check_step(solver);
    const auto ledger = records.write(
        body, solver, [&] { return solver.reactions(); }, last);
    if (ledger) watch.check_energy(*ledger);
    progress.show(solver.steps(), now, solver.dt());
    if (last) break;
    solver.request(signalled ? Request::stop : checkpoint.due_by_the_clock() ? Request::save : Request::none);
    const double next = now + solver.dt();
    const int step = solver.steps() + 1;
    ending = solver.agreed_request() == Request::stop;
    saving = solver.agreed_request() == Request::save;
    solver.advance_position(next >= final_time || ending || saving || records.due(step, next) ||
                            checkpoint.due(step, next));
  }
  progress.finish();
  return solver.ledger();
}

// The same by load steps.
Ledger load_through(const deck::Deck& deck, Scene& scene, QuasiStatic& solver, OutputWriters& records,
                    Checkpoint& checkpoint, Monitor& watch) {
  const int conditions = records.history.has_reactions() ? static_cast<int>(deck.conditions.size()) : 0;
  const Communicator& ranks = scene.body.domain.communicator;
  const auto record = [&](bool last) {
    return records.write(
        scene.body, solver, [&] { return solver.reactions(conditions); }, last);
  };
  bool ending = false, save = false;
  for (;;) {
    const bool over = solver.time() >= deck.solver.final_time, last = ending || over;
    if (over) save = checkpoint.due_at_the_end();
    if (save || checkpoint.due(solver.steps(), solver.time())) checkpoint.write(solver.steps(), solver.time());
    const auto ledger = record(last);
    if (ledger) watch.check_energy(*ledger);
    if (last) return solver.ledger();
    try {
      ending = !solver.advance();
    } catch (const Error&) {
      quietly([&] { record(true); });
      throw;
    }
    ending = ranks.max(ending || signalled ? 1.0 : 0.0) > 0;
    save = ending || ranks.max(checkpoint.due_by_the_clock() ? 1.0 : 0.0) > 0;
  }
}

Observer observer(const deck::Deck& deck, const Communicator& communicator) {
  const auto tell = [&communicator](const std::string& line) { say(communicator, line + "\n"); };
  Observer observer{tell, {}, [] { return signalled != 0; }};
  if (deck.solver.verbose) observer.iterations = tell;
  return observer;
}

// From set-up to the end, by a solver of either kind.
template <class Solver, class Through>
bool carry_out(const deck::Deck& deck, Scene& scene, OutputWriters& records, Solver& solver, Start start,
               Clock::time_point began, const Through& through) {
  const Communicator& communicator = scene.body.domain.communicator;
  Monitor watch(deck.watch, scene.body, tell);
  Checkpoint checkpoint(deck, communicator, [&](Archive& archive) {
    solver.serialize(archive);
    watch.serialize(archive);
    records.serialize(archive, solver.time());
  });
  if (start == Start::continued && checkpoint_exists(deck, communicator)) {
    checkpoint.load();
  } else {
    checkpoint.remove();
  }
  records.open(scene.body);
  const int before = solver.steps();
  catch_signals();
  const Ledger ledger = [&] {
    try {
      return through(checkpoint, watch);
    } catch (const Error& error) {
      leave_frame(records, solver.time(), scene.body);
      throw Error(error.what() + checkpoint.hint());
    }
  }();
  const bool over = solver.time() >= deck.solver.final_time;
  if (over) checkpoint.close();
  const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
  say(communicator, closing_report(scene, solver, ledger, seconds, before));
  if (!over) say(communicator, "ended by a signal" + checkpoint.hint() + "\n");
  return over;
}

}  // namespace

bool run(const std::filesystem::path& deck_file, const Communicator& communicator, Start start) {
  const Clock::time_point began = Clock::now();
  const deck::Deck deck = deck::read(deck_file, communicator);
  if (start == Start::continued && !checkpoint_exists(deck, communicator) && is_over(deck, communicator)) {
    say(communicator, deck.output.file.string() + " is of a run that is over: there is nothing to go on with\n");
    return true;
  }
  Scene scene = set_up(deck, communicator);
  say(communicator, describe_scene(scene));
  const OutputVariables variables =
      output_variables_of(deck, scene.body);  // all names are checked before a file is replaced
  OutputWriters records(deck, variables);
  if (scene.quasi_static) {
    QuasiStatic solver(scene.body, std::move(scene.conditions), std::move(scene.contact), *scene.quasi_static,
                       deck.solver.initial_time, deck.solver.final_time, observer(deck, communicator));
    return carry_out(deck, scene, records, solver, start, began, [&](Checkpoint& checkpoint, Monitor& watch) {
      return load_through(deck, scene, solver, records, checkpoint, watch);
    });
  }
  CentralDifference solver(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                           deck.solver.initial_time);
  if (records.history.has_reactions()) solver.gather_reactions(static_cast<int>(deck.conditions.size()));
  return carry_out(deck, scene, records, solver, start, began, [&](Checkpoint& checkpoint, Monitor& watch) {
    return step_through(deck, scene, solver, records, checkpoint, watch);
  });
}

}  // namespace strut
