#include "run/simulation.hpp"

#include <csignal>
#include <iomanip>
#include <iostream>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/timing.hpp"
#include "checkpoint/checkpoint.hpp"
#include "mechanics/serialize.hpp"
#include "output/variables.hpp"
#include "run/balance.hpp"
#include "run/input.hpp"
#include "run/monitor.hpp"
#include "run/report.hpp"
#include "run/run_control.hpp"
#include "run/start_from.hpp"
#include "setup/families.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

using Clock = EarlyEnd::Clock;

// Prints a line on the calling rank.
void tell(const std::string& line) { std::cout << line << std::endl; }

// Ignores errors of the action, so that the message of an earlier error stays the last one.
template <class Action>
void quietly(Action&& action) {
  try {
    action();
  } catch (const Error&) {
  }
}

// Writes the present fields when a run ends with an error: they show where it happened.
void leave_frame(OutputWriters& writers, double time, const Body& body) {
  if (!writers.frames.is_open() || writers.frames.has(time)) return;
  quietly([&] { writers.frames.write(time, body); });
}

Observer observer(const deck::Deck& deck, const Communicator& communicator, const EarlyEnd& early_end) {
  const auto tell = [&communicator](const std::string& line) { say(communicator, line + "\n"); };
  Observer observer{tell, {}, [&early_end] { return early_end.wanted(); }};
  if (deck.solver.verbose) observer.iterations = tell;
  return observer;
}

}  // namespace

// The objects of a run. A step leaves a time and arrives at the next one.
struct Run::Parts {
  Clock::time_point began = Clock::now();
  deck::Deck deck;
  Communicator communicator;
  EarlyEnd early_end;
  std::optional<Scene> scene;  // stays at this address, also when another scene replaces it
  std::optional<OutputWriters> writers;
  Balance balance;
  std::optional<CentralDifference> steps;  // in a run of explicit steps
  std::optional<QuasiStatic> equilibria;   // in a run of equilibria; exactly one of both solvers exists
  std::optional<Monitor> monitor;
  std::optional<UserLibraries> libraries;
  std::optional<Checkpoint> checkpoint;
  std::optional<Progress> progress;  // of explicit steps
  int before = 0;                    // number of steps of the earlier run that this one resumes
  HistoryRows* history = nullptr;
  bool begun = false, ended = false;
  bool last = false, ending = false, saving = false;  // at this time, as all ranks have agreed
  bool warned = false;                                // that the fixed step is above the critical one

  Parts(deck::Deck of_run, const Communicator& ranks)
      : deck(std::move(of_run)), communicator(ranks), early_end(began, deck.solver.wall_time), balance(deck) {}

  template <class Action>
  auto with_solver(const Action& action) {
    return equilibria ? action(*equilibria) : action(*steps);
  }
  double time() {
    return with_solver([](const auto& solver) { return solver.time(); });
  }
  int number_of_steps() {
    return with_solver([](const auto& solver) { return solver.steps(); });
  }
  bool is_over() { return time() >= deck.solver.final_time; }

  void set_up(deck::Problems problems, const InMemory& in_memory, Start start) {
    const bool has_expanded = check_checkpoint(deck, start == Start::anew, communicator, problems);
    const bool continued = start == Start::continued && checkpoint_exists(deck, communicator);
    libraries.emplace(deck, communicator);
    std::optional<StartState> state;
    if (!continued) state = start_state_of(deck, communicator, problems);
    PointCloud mesh = checked_mesh(deck, std::move(problems), communicator, in_memory.mesh);
    read_cracks(deck, communicator);
    scene = strut::set_up(deck, std::move(mesh), communicator);
    const std::string started = state ? state->restore(deck, *scene) : "";
    keep_expansion(has_expanded, scene->body);
    // Advice is about the state at the start of a run. A continued run that began with Start From is past that state,
    // and its mesh does not show it.
    const bool is_past = continued && deck.start_from;
    const Advice outline = is_past ? Advice{"advice was given at the start\n", scene->warnings} : advice(deck, *scene);
    say(communicator, describe_scene(*scene, outline) + started);
    writers.emplace(
        deck, output_variables_of(deck, scene->body, scene->contact));  // checks all names before a file is replaced
    history = in_memory.history;
    writers->history.keep_rows(history);
    make_solver(continued, state ? &*state : nullptr);
    open(continued);
  }

  // `state`: the state of another run, which the body already has.
  void make_solver(bool continued, StartState* state = nullptr) {
    const deck::Solver& times = deck.solver;
    if (scene->quasi_static) {
      equilibria.emplace(scene->body, std::move(scene->conditions), std::move(scene->contact), *scene->quasi_static,
                         times.initial_time, times.final_time, observer(deck, communicator, early_end),
                         std::move(scene->fracture));
      if (state) state->begin(*equilibria);
      return;
    }
    const auto make = [&](auto beginning) {
      steps.emplace(scene->body, std::move(scene->conditions), std::move(scene->contact), scene->control, beginning,
                    std::move(scene->fracture));
      // Before it is restored: the impulses of substeps are then restored, too.
      if (writers->history.has_reactions()) steps->gather_reactions(static_cast<int>(deck.conditions.size()));
    };
    if (state && state->goes_on()) {
      make(CentralDifference::ToBeRestored());
      state->go_on(*steps);
    } else if (continued) {
      make(CentralDifference::ToBeRestored());  // by open(); the mesh may not fit the conditions of the initial time
    } else {
      make(times.initial_time);
      if (state) say(communicator, state->overlaps(steps->contact(), scene->body));
    }
  }

  void open(bool continued) {
    monitor.emplace(deck.watch, deck.solver.final_time - deck.solver.initial_time, scene->body, tell);
    checkpoint.emplace(deck, communicator, [this](Archive& archive) {
      with_solver([&](auto& solver) { solver.serialize(archive); });
      serialize_sets(archive, scene->body, names_of_probes(deck));
      monitor->serialize(archive, scene->tools.size());
      balance.serialize(archive, scene->body);
      writers->serialize(archive, number_of_steps(), time());
      libraries->serialize(archive);
      if (const std::string changed = libraries->changed(); !changed.empty())
        throw Error(changed + "; a run can go on with the same one only");
    });
    continued ? checkpoint->load() : checkpoint->remove();
    writers->open(scene->body);
    before = number_of_steps();
  }

  void begin() {
    begun = true;
    if (equilibria) return;
    if (const auto ranks = balance.take_restored_ranks()) repartition({deck, scene, steps, writers}, *ranks);
    say(communicator, text_of(std::setprecision(4), "critical time step ", steps->critical_time_step(), " s\n"));
    check_step_at(steps->time(), scene->control, steps->critical_time_step());
    if (before == 0) check_libraries(scene->body, scene->control, steps->critical_time_step());
    progress.emplace(communicator, deck.solver.initial_time, time(), deck.solver.final_time);
  }

  void arrive() {
    last = ending || is_over();
    save();
    if (equilibria) return watch_equilibrium();
    if (!last && !steps->went_on()) {  // the monitor must first report the point
      if (const auto ranks = balance.better_ranks(*scene, *steps)) repartition({deck, scene, steps, writers}, *ranks);
    }
    steps->advance_velocity(deck.solver.final_time);
    watch_step();
  }

  void leave(const Pause& pause) { equilibria ? leave_equilibrium() : leave_step(pause); }

  void save() {
    const bool wanted = is_over() ? checkpoint->is_scheduled_at_end() : ending || saving;
    if (wanted || checkpoint->is_scheduled(number_of_steps(), time())) checkpoint->write(number_of_steps(), time());
  }

  std::optional<Ledger> record() {
    if (steps) {
      return writers->write(
          scene->body, *steps, [&] { return steps->reactions(); }, last);
    }
    const int conditions = writers->history.has_reactions() ? static_cast<int>(deck.conditions.size()) : 0;
    return writers->write(
        scene->body, *equilibria, [&] { return equilibria->reactions(conditions); }, last);
  }

  void watch_step() {
    CentralDifference& solver = *steps;
    warn_of_fixed_step();
    monitor->check_step(solver);
    watch_bodies(solver);
    writers->history.gather(solver.impulses(), solver.contact(), scene->body.domain);
    const auto ledger = record();
    if (ledger || last || monitor->is_energy_check_scheduled(solver.time())) {
      const Ledger now = ledger ? *ledger : solver.ledger();
      monitor->check_energy(now, last);
      monitor->check_resolution(now, last);
      monitor->check_inverted(now.time);
      monitor->check_soft_contact(now, solver.contact(), last, Monitor::Steps::of_time);
      if (last && solver.fracture()) monitor->check_breaks(*solver.fracture(), solver.time());
    }
    progress->show(solver.steps(), solver.time(), solver.dt());
  }

  void watch_equilibrium() {
    const auto recorded = record();
    const Ledger ledger = recorded ? *recorded : equilibria->ledger();
    monitor->check_energy(ledger, last);
    monitor->check_soft_contact(ledger, equilibria->contact(), last, Monitor::Steps::of_load);
    if (last) monitor->check_plastic_work(ledger, equilibria->missed_plastic_work());
    monitor->check_failed(time());
    monitor->check_inverted(time());
    watch_bodies(*equilibria);
  }

  template <class Solver>
  void watch_bodies(Solver& solver) {
    monitor->check_interpenetration(solver.time(), solver.contact());
    monitor->check_undeclared(solver.time(), solver.contact());
    const auto kind = steps ? Monitor::Steps::of_time : Monitor::Steps::of_load;
    monitor->check_tools(solver.time(), solver.conditions(), scene->tools, kind);
  }

  void warn_of_fixed_step() {
    const double limit = steps->critical_time_step();
    if (warned || !(scene->control.fixed_dt > limit)) return;
    say(communicator, step_warning(scene->control, limit, time()));
    warned = true;
  }

  // Ranks agree on the tasks of the next time one step ahead, so that all compute energies at times of output or
  // checkpoints.
  bool is_something_scheduled_next() {
    using Request = CentralDifference::Request;
    steps->request(early_end.wanted()                    ? Request::stop
                   : checkpoint->is_scheduled_by_clock() ? Request::save
                                                         : Request::none);
    ending = steps->agreed_request() == Request::stop;
    saving = steps->agreed_request() == Request::save;
    const double next = time() + steps->dt();
    const int step = number_of_steps() + 1;
    return next >= deck.solver.final_time || ending || saving || writers->is_scheduled(step, next) ||
           monitor->is_energy_check_scheduled(next) || checkpoint->is_scheduled(step, next);
  }

  void leave_step(const Pause& pause) {
    const bool with_diagnostics = is_something_scheduled_next();
    const bool pauses = pause.steps <= 1 || time() + steps->dt() >= pause.time;
    steps->advance_position(with_diagnostics || pauses);
  }

  void leave_equilibrium() {
    try {
      ending = !equilibria->advance();
    } catch (const Error&) {
      last = true;
      quietly([&] { record(); });
      throw;
    }
    ending = communicator.any(ending || early_end.wanted());
    saving = ending || communicator.any(checkpoint->is_scheduled_by_clock());
  }

  // After an error the run writes a frame, says how to resume, and has ended.
  template <class Action>
  void guarded(const Action& action) {
    ended = true;
    const auto failed = [this](const Error& error) {
      const std::string text = error.what() + checkpoint->hint();
      close();
      return Error(text);
    };
    try {
      action();
    } catch (const LostState& error) {
      throw failed(error);
    } catch (const Error& error) {
      leave_frame(*writers, time(), scene->body);
      throw failed(error);
    }
    ended = last;
  }

  bool steps_follow() { return last && is_over() && equilibria && deck.next_solver; }

  // Starts the explicit steps after equilibria (Solver 2): the same body and files, no checkpoints.
  void hand_over() {
    report();
    const Ledger before = equilibria->ledger();
    deck = set_up_next(deck, equilibria->conditions(), equilibria->take_contact(), equilibria->take_fracture(), *scene);
    say(communicator,
        text_of("\nSolver 2: explicit steps from t = ", deck.solver.initial_time, " s\n", scene->warnings));
    Snapshot snapshot;
    Archive saved = Archive::saving_to(snapshot);
    writers->serialize(saved, number_of_steps(), time());
    close();
    writers.emplace(deck, output_variables_of(deck, scene->body, scene->contact));
    writers->history.keep_rows(history);
    Archive restored = Archive::loading_from(snapshot);
    writers->serialize(restored, number_of_steps(), time());
    equilibria.reset();
    balance = Balance(deck);
    make_solver(false);
    steps->go_on_from(before);
    open(false);
    begun = last = ending = saving = false;
  }

  void report() {
    const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
    say(communicator,
        with_solver([&](auto& solver) { return closing_report(*scene, solver, solver.ledger(), seconds, before); }));
  }

  void finish() {
    if (progress) progress->finish();
    if (is_over()) checkpoint->close();
    report();
    say(communicator, is_over() ? checkpoint->kept() : early_end.reason(communicator) + checkpoint->hint() + "\n");
    close();
  }

  // Closes the files, for other runs of this process; the fields stay.
  void close() {
    progress.reset();
    checkpoint.reset();
    writers.reset();
  }
};

Run::Run(deck::Deck deck, deck::Problems problems, const Communicator& communicator, Start start,
         const InMemory& in_memory)
    : parts_(std::make_unique<Parts>(std::move(deck), communicator)) {
  reset_phases();
  parts_->set_up(std::move(problems), in_memory, start);
}

Run::~Run() = default;

bool Run::advance(const Pause& pause) {
  Parts& run = *parts_;
  if (run.ended) return false;
  Pause left = pause;
  run.guarded([&] {
    do {
      if (run.steps_follow()) run.hand_over();
      if (!run.begun) {
        run.begin();
        run.arrive();
      }
      for (; !run.last && left.steps > 0 && run.time() < pause.time; --left.steps) {
        run.leave(left);
        run.arrive();
      }
    } while (run.steps_follow());
  });
  if (run.last) run.finish();
  return !run.last;
}

void Run::end() {
  parts_->early_end.ask();
  advance();
}

bool Run::has_ended() const { return parts_->ended; }
bool Run::is_over() const { return parts_->is_over(); }
double Run::time() const { return parts_->time(); }
int Run::steps() const { return parts_->number_of_steps(); }
const Scene& Run::scene() const { return *parts_->scene; }

bool run(const std::filesystem::path& deck_file, const Communicator& communicator, Start start) {
  forget_signals();
  // A job that is stopped while the mesh is read continues in the next one; other signals end it at once.
  catch_signals({SIGUSR1, SIGUSR2, SIGXCPU});
  deck::Problems problems;
  deck::Deck deck = deck::read(deck_file, communicator, problems);
  if (start == Start::continued && problems.empty() && !checkpoint_exists(deck, communicator) &&
      is_over(deck, communicator)) {
    const auto& file = deck.output.enabled ? deck.output.file : deck.history.file;
    say(communicator, file.string() + " is of a run that is over: there is nothing to go on with\n");
    return true;
  }
  Run run(std::move(deck), std::move(problems), communicator, start);
  catch_signals({SIGINT, SIGTERM, SIGHUP});
  run.advance();
  return run.is_over();
}

}  // namespace strut
