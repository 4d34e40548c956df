#include "run/run_control.hpp"

#include <atomic>
#include <csignal>
#include <iostream>

#include "base/parallel/communicator.hpp"

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

int caught_signal() { return signalled; }

void forget_signals() { signalled = 0; }

bool EarlyEnd::wanted() const {
  const auto passed = [this] { return std::chrono::duration<double>(Clock::now() - began_).count(); };
  return asked_ || signalled != 0 || (wall_time_ && passed() > *wall_time_);
}

std::string EarlyEnd::reason(const Communicator& communicator) const {
  if (asked_) return "ended as it was asked to";
  return communicator.any(signalled != 0) ? "ended by a signal" : "ended by its Wall Time";
}

void say(const Communicator& communicator, const std::string& text) {
  if (communicator.rank() == 0) std::cout << text << std::flush;
}

}  // namespace strut
