#include "simulation.hpp"

#include <chrono>
#include <csignal>
#include <iostream>

#include "base/errors.hpp"
#include "deck/deck.hpp"
#include "records.hpp"
#include "report.hpp"
#include "restarts.hpp"
#include "setup.hpp"
#include "views.hpp"
#include "watch.hpp"

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
void leave_frame(Records& records, double time, const Body& body) {
  if (!records.frames.enabled() || records.frames.has(time)) return;
  quietly([&] { records.frames.write(time, body); });
}

// Everything after set-up: the loop over steps. Returns the ledger at the end.
Ledger step_through(const deck::Deck& deck, Scene& scene, CentralDifference& solver, Records& records,
                    Restarts& restarts, Watch& watch) {
  using Wish = CentralDifference::Wish;
  const double final_time = deck.solver.final_time;
  const Body& body = scene.body;
  Progress progress(body.domain.communicator, deck.solver.initial_time, solver.time(), final_time);
  bool warned = false;
  // A step after the ranks agreed, so that energies are known everywhere at the times that are looked at or kept.
  bool ending = false, saving = false;
  for (;;) {
    const double now = solver.time();
    const bool over = now >= final_time, last = over || ending;
    const bool save = over ? restarts.due_at_the_end() : ending || saving;
    if (save || restarts.due(solver.steps(), now)) restarts.write(solver.steps(), now);
    solver.kick(final_time);
    if (!warned && scene.control.fixed_dt > solver.stable_step()) {
      say(body.domain.communicator, step_warning(scene.control, solver.stable_step(), now));
      warned = true;
    }
    watch.look_at_step(solver);
    const auto ledger = records.write(
        body, solver, [&] { return solver.reactions(); }, last);
    if (ledger) watch.look_at_energy(*ledger);
    progress.show(solver.steps(), now, solver.dt());
    if (last) break;
    solver.request(signalled ? Wish::stop : restarts.due_by_the_clock() ? Wish::save : Wish::none);
    const double next = now + solver.dt();
    const int step = solver.steps() + 1;
    ending = solver.agreed() == Wish::stop;
    saving = solver.agreed() == Wish::save;
    solver.move(next >= final_time || ending || saving || records.due(step, next) || restarts.due(step, next));
  }
  progress.finish();
  return solver.ledger();
}

// The same by load steps.
Ledger load_through(const deck::Deck& deck, Scene& scene, QuasiStatic& solver, Records& records, Restarts& restarts,
                    Watch& watch) {
  const int conditions = records.history.has_reactions() ? static_cast<int>(deck.conditions.size()) : 0;
  const Communicator& ranks = scene.body.domain.communicator;
  const auto record = [&](bool last) {
    return records.write(
        scene.body, solver, [&] { return solver.reactions(conditions); }, last);
  };
  bool ending = false, save = false;
  for (;;) {
    const bool over = solver.time() >= deck.solver.final_time, last = ending || over;
    if (over) save = restarts.due_at_the_end();
    if (save || restarts.due(solver.steps(), solver.time())) restarts.write(solver.steps(), solver.time());
    const auto ledger = record(last);
    if (ledger) watch.look_at_energy(*ledger);
    if (last) return solver.ledger();
    try {
      ending = !solver.advance();
    } catch (const Error&) {
      quietly([&] { record(true); });
      throw;
    }
    ending = ranks.max(ending || signalled ? 1.0 : 0.0) > 0;
    save = ending || ranks.max(restarts.due_by_the_clock() ? 1.0 : 0.0) > 0;
  }
}

Audience audience(const deck::Deck& deck, const Communicator& communicator) {
  const auto tell = [&communicator](const std::string& line) { say(communicator, line + "\n"); };
  Audience audience{tell, {}, [] { return signalled != 0; }};
  if (deck.solver.verbose) audience.iterations = tell;
  return audience;
}

// From set-up to the end, by a solver of either kind.
template <class Solver, class Through>
bool carry_out(const deck::Deck& deck, Scene& scene, Records& records, Solver& solver, Start start,
               Clock::time_point began, const Through& through) {
  const Communicator& communicator = scene.body.domain.communicator;
  Watch watch(deck.watch, scene.body, tell);
  Restarts restarts(deck, communicator, [&](Archive& archive) {
    solver.keep(archive);
    watch.keep(archive);
    records.keep(archive, solver.time());
  });
  if (start == Start::continued && restart_is_there(deck, communicator)) {
    restarts.take_up();
  } else {
    restarts.forget();
  }
  records.open(scene.body);
  const int before = solver.steps();
  catch_signals();
  const Ledger ledger = [&] {
    try {
      return through(restarts, watch);
    } catch (const Error& error) {
      leave_frame(records, solver.time(), scene.body);
      throw Error(error.what() + restarts.hint());
    }
  }();
  const bool over = solver.time() >= deck.solver.final_time;
  if (over) restarts.close();
  const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
  say(communicator, closing_report(scene, solver, ledger, seconds, before));
  if (!over) say(communicator, "ended by a signal" + restarts.hint() + "\n");
  return over;
}

}  // namespace

bool run(const std::filesystem::path& deck_file, const Communicator& communicator, Start start) {
  const Clock::time_point began = Clock::now();
  const deck::Deck deck = deck::read(deck_file, communicator);
  if (start == Start::continued && !restart_is_there(deck, communicator) && is_over(deck, communicator)) {
    say(communicator, deck.output.file.string() + " is of a run that is over: there is nothing to go on with\n");
    return true;
  }
  Scene scene = set_up(deck, communicator);
  say(communicator, describe_scene(scene));
  const Views views = views_of(deck, scene.body);  // all names are checked before a file is replaced
  Records records(deck, views);
  if (scene.quasi_static) {
    QuasiStatic solver(scene.body, std::move(scene.conditions), std::move(scene.contact), *scene.quasi_static,
                       deck.solver.initial_time, deck.solver.final_time, audience(deck, communicator));
    return carry_out(deck, scene, records, solver, start, began, [&](Restarts& restarts, Watch& watch) {
      return load_through(deck, scene, solver, records, restarts, watch);
    });
  }
  CentralDifference solver(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                           deck.solver.initial_time);
  if (records.history.has_reactions()) solver.gather_reactions(static_cast<int>(deck.conditions.size()));
  return carry_out(deck, scene, records, solver, start, began, [&](Restarts& restarts, Watch& watch) {
    return step_through(deck, scene, solver, records, restarts, watch);
  });
}

}  // namespace strut
