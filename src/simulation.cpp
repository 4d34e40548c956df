#include "simulation.hpp"

#include <chrono>
#include <csignal>
#include <iostream>
#include <optional>

#include "base/errors.hpp"
#include "base/timing.hpp"
#include "deck/deck.hpp"
#include "io/exodus.hpp"
#include "io/history.hpp"
#include "report.hpp"
#include "schedule.hpp"
#include "setup.hpp"
#include "views.hpp"

namespace strut {

namespace {

volatile std::sig_atomic_t signalled = 0;

void catch_signals() {
  std::signal(SIGINT, [](int) { signalled = 1; });
  std::signal(SIGTERM, [](int) { signalled = 1; });
}

// The frames of the result file.
class Frames {
 public:
  Frames(const deck::Deck& deck, const Body& body, const Views& views)
      : schedule(deck.output.enabled, deck.output.frequency, deck.output.interval, deck.solver.initial_time),
        variables_(views.frame),
        columns_(views.frame.size()) {
    if (!deck.output.enabled) return;
    std::vector<io::OutputField> fields;
    for (const Observable& v : variables_) fields.push_back({v.name, v.components, v.nodal});
    writer_.emplace(deck.output.file, body.domain.communicator, body.domain.cloud, std::move(fields));
  }

  void write(double time, const Body& body) {
    static Teuchos::Time& timer = phase("Output");
    const Timed timed(timer);
    for (std::size_t v = 0; v < variables_.size(); ++v) variables_[v].fill(body, columns_[v]);
    writer_->write(time, columns_);
    schedule.done(time);
  }

  Schedule schedule;

 private:
  std::vector<Observable> variables_;
  std::vector<std::vector<double>> columns_;
  std::optional<io::ExodusWriter> writer_;
};

// The table of the ledger and of asked-for extremes and reactions over time.
class History {
 public:
  History(const deck::Deck& deck, const Body& body, const Views& views)
      : schedule(deck.history.enabled, deck.history.frequency, deck.history.interval, deck.solver.initial_time),
        extremes_(views.extremes),
        reactions_(views.reactions) {
    if (!deck.history.enabled) return;
    std::vector<std::string> names{
        "Time",         "Step_Size",     "Kinetic_Energy", "Elastic_Energy", "Plastic_Work", "Stabilization_Energy",
        "Contact_Work", "External_Work", "Balance_Error",  "Momentum_X",     "Momentum_Y",   "Momentum_Z"};
    for (const Extreme& extreme : extremes_) names.push_back(extreme.name());
    for (const ReactionComponent& reaction : reactions_) names.push_back(reaction.name);
    file_.emplace(deck.history.file, body.domain.communicator, names);
  }

  void write(const Ledger& now, const Reactions& reactions, const Body& body) {
    static Teuchos::Time& timer = phase("History");
    const Timed timed(timer);
    std::vector<double> row{now.time,          now.dt,         now.kinetic,  now.elastic,       now.dissipated,
                            now.stabilization, now.contact,    now.external, now.balance_error, now.momentum[0],
                            now.momentum[1],   now.momentum[2]};
    const std::size_t fixed = row.size();
    for (const Extreme& e : extremes_) row.push_back(e.local(body));
    body.domain.communicator.max(std::span(row).subspan(fixed));
    for (std::size_t k = 0; k < extremes_.size(); ++k) row[fixed + k] = extremes_[k].value(row[fixed + k]);
    for (const ReactionComponent& reaction : reactions_) row.push_back(reaction.of(reactions));
    file_->write(row);
    schedule.done(now.time);
  }

  bool has_reactions() const { return !reactions_.empty(); }

  Schedule schedule;

 private:
  std::vector<Extreme> extremes_;
  std::vector<ReactionComponent> reactions_;
  std::optional<io::HistoryFile> file_;
};

void say(const Communicator& communicator, const std::string& text) {
  if (communicator.rank() == 0) std::cout << text << std::flush;
}

// Frame and line of history where they are due, or, at the last time, in any case. `reactions`: asked where a line is
// written.
template <class Solver, class OfConditions>
void record(const deck::Deck& deck, const Body& body, Solver& solver, const OfConditions& reactions, Frames& frames,
            History& history, bool last) {
  const double now = solver.time();
  if (deck.output.enabled && (last || frames.schedule.due(solver.steps(), now))) frames.write(now, body);
  if (deck.history.enabled && (last || history.schedule.due(solver.steps(), now))) {
    history.write(solver.ledger(), reactions(), body);
  }
}

// Everything after set-up: the loop over steps. Returns the ledger at the end.
Ledger step_through(const deck::Deck& deck, Scene& scene, CentralDifference& solver, Frames& frames, History& history) {
  const double final_time = deck.solver.final_time;
  Progress progress(scene.body.domain.communicator, deck.solver.initial_time, final_time);
  bool warned = false;
  bool ending = false;  // a step after the ranks agreed to stop, so that its energies are known everywhere
  for (;;) {
    const double now = solver.time();
    const bool last = now >= final_time || ending;
    solver.kick(final_time);
    if (!warned && scene.control.fixed_dt > solver.stable_step()) {
      say(scene.body.domain.communicator, step_warning(scene.control, solver.stable_step(), now));
      warned = true;
    }
    record(
        deck, scene.body, solver, [&] { return solver.reactions(); }, frames, history, last);
    progress.show(solver.steps(), now, solver.dt());
    if (last) break;
    if (signalled) solver.request_stop();
    const double next = now + solver.dt();
    ending = solver.stop_agreed();
    const bool look = frames.schedule.due(solver.steps() + 1, next) || history.schedule.due(solver.steps() + 1, next);
    solver.move(next >= final_time || ending || look);
  }
  progress.finish();
  return solver.ledger();
}

// The same by load steps. One that fails leaves the last equilibrium in the files.
Ledger load_through(const deck::Deck& deck, Scene& scene, QuasiStatic& solver, Frames& frames, History& history) {
  const int conditions = history.has_reactions() ? static_cast<int>(deck.conditions.size()) : 0;
  const Communicator& ranks = scene.body.domain.communicator;
  const auto record_now = [&](bool last) {
    record(
        deck, scene.body, solver, [&] { return solver.reactions(conditions); }, frames, history, last);
  };
  bool ending = false;
  for (;;) {
    const bool last = ending || solver.time() >= deck.solver.final_time;
    record_now(last);
    if (last) return solver.ledger();
    try {
      ending = !solver.advance();
    } catch (const Error&) {
      record_now(true);
      throw;
    }
    ending = ending || ranks.max(signalled ? 1.0 : 0.0) > 0;
  }
}

Audience audience(const deck::Deck& deck, const Communicator& communicator) {
  const auto tell = [&communicator](const std::string& line) { say(communicator, line + "\n"); };
  Audience audience{tell, {}, [] { return signalled != 0; }};
  if (deck.solver.verbose) audience.iterations = tell;
  return audience;
}

}  // namespace

bool run(const std::filesystem::path& deck_file, const Communicator& communicator) {
  const auto start = std::chrono::steady_clock::now();
  const deck::Deck deck = deck::read(deck_file, communicator);
  Scene scene = set_up(deck, communicator);
  say(communicator, describe_scene(scene));
  const Views views = views_of(deck, scene.body);  // all names are checked before a file is replaced
  Frames frames(deck, scene.body, views);
  History history(deck, scene.body, views);
  catch_signals();
  const auto close = [&](const auto& solver, const Ledger& ledger) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    say(communicator, closing_report(scene, solver, ledger, seconds));
    return solver.time() >= deck.solver.final_time;
  };
  if (scene.quasi_static) {
    QuasiStatic solver(scene.body, std::move(scene.conditions), std::move(scene.contact), *scene.quasi_static,
                       deck.solver.initial_time, deck.solver.final_time, audience(deck, communicator));
    return close(solver, load_through(deck, scene, solver, frames, history));
  }
  CentralDifference solver(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                           deck.solver.initial_time);
  if (history.has_reactions()) solver.gather_reactions(static_cast<int>(deck.conditions.size()));
  return close(solver, step_through(deck, scene, solver, frames, history));
}

}  // namespace strut
