#include "run/run_control.hpp"

#include <atomic>
#include <csignal>
#include <iostream>

namespace strut {

namespace {

std::atomic<int> signalled = 0;  // any thread may call the handler

}  // namespace

void catch_signals(std::initializer_list<int> signals) {
  for (const int signal : signals) {
    const auto before = std::signal(signal, [](int number) { signalled = number; });
    if (signal == SIGHUP && before == SIG_IGN) std::signal(signal, SIG_IGN);  // ignored by nohup
  }
}

bool is_signalled() { return signalled != 0; }

int caught_signal() { return signalled; }

void forget_signals() { signalled = 0; }

bool EarlyEnd::wanted() const {
  const auto passed = [this] { return std::chrono::duration<double>(Clock::now() - began_).count(); };
  return asked_ || is_signalled() || (wall_time_ && passed() > *wall_time_);
}

std::string EarlyEnd::reason(const Communicator& communicator) const {
  if (asked_) return "ended as it was asked to";
  return communicator.max(is_signalled() ? 1.0 : 0.0) > 0 ? "ended by a signal" : "ended by its Wall Time";
}

void say(const Communicator& communicator, const std::string& text) {
  if (communicator.rank() == 0) std::cout << text << std::flush;
}

ExplicitRunControl::ExplicitRunControl(const RunServices& services, const CentralDifference& solver)
    : services_(services),
      progress_(services.scene.body.domain.communicator, services.deck.solver.initial_time, solver.time(),
                services.deck.solver.final_time) {}

void ExplicitRunControl::save(CentralDifference& solver) {
  Checkpoint& checkpoint = services_.checkpoint;
  const bool wanted = is_over(solver) ? checkpoint.due_at_the_end() : ending_ || saving_;
  if (wanted || checkpoint.due(solver.steps(), solver.time())) checkpoint.write(solver.steps(), solver.time());
}

bool ExplicitRunControl::observe(CentralDifference& solver) {
  warn_of_fixed_step(solver);
  services_.monitor.check_step(solver);
  services_.monitor.check_interpenetration(solver.time(), solver.contact());
  services_.monitor.check_undeclared(solver.time(), solver.contact());
  services_.monitor.check_tools(solver.time(), solver.conditions(), services_.scene.tools);
  const bool last = ends_here(solver);
  services_.writers.history.gather(solver.impulses(), solver.contact(), services_.scene.body.domain);
  const auto ledger = services_.writers.write(
      services_.scene.body, solver, [&] { return solver.reactions(); }, last);
  if (ledger || last || services_.monitor.is_energy_due(solver.time())) {
    const Ledger now = ledger ? *ledger : solver.ledger();
    services_.monitor.check_energy(now, last);
    services_.monitor.check_resolution(now, last);
  }
  progress_.show(solver.steps(), solver.time(), solver.dt());
  return last;
}

void ExplicitRunControl::warn_of_fixed_step(const CentralDifference& solver) {
  const StepControl& control = services_.scene.control;
  if (warned_ || !(control.fixed_dt > solver.critical_time_step())) return;
  say(services_.scene.body.domain.communicator, step_warning(control, solver.critical_time_step(), solver.time()));
  warned_ = true;
}

bool ExplicitRunControl::prepare_next(CentralDifference& solver) {
  using Request = CentralDifference::Request;
  const Checkpoint& checkpoint = services_.checkpoint;
  solver.request(services_.early_end.wanted()    ? Request::stop
                 : checkpoint.due_by_the_clock() ? Request::save
                                                 : Request::none);
  ending_ = solver.agreed_request() == Request::stop;
  saving_ = solver.agreed_request() == Request::save;
  const double next = solver.time() + solver.dt();
  const int step = solver.steps() + 1;
  return next >= services_.deck.solver.final_time || ending_ || saving_ || services_.writers.due(step, next) ||
         services_.monitor.is_energy_due(next) || checkpoint.due(step, next);
}

}  // namespace strut
