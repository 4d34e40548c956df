// The end of a run before its final time: signals, its wall time, its owner.
#pragma once

#include <chrono>
#include <initializer_list>
#include <optional>
#include <string>

namespace strut {

class Communicator;

// From now on these signals (of csignal) end the run after the current step, or its first one.
void catch_signals(std::initializer_list<int> signals);
int caught_signal();    // its number; 0: none
void forget_signals();  // for a process that runs several decks

// True if a run must end before its final time, on this rank: a signal has come, its wall time is over, or its owner
// asks for it. The callers agree on it over the ranks.
class EarlyEnd {
 public:
  using Clock = std::chrono::steady_clock;
  EarlyEnd(Clock::time_point began, std::optional<double> wall_time) : began_(began), wall_time_(wall_time) {}  // s

  void ask() { asked_ = true; }  // on all ranks
  bool wanted() const;
  std::string reason(const Communicator& communicator) const;  // collective

 private:
  Clock::time_point began_;
  std::optional<double> wall_time_;
  bool asked_ = false;
};

// Prints on rank 0.
void say(const Communicator& communicator, const std::string& text);

}  // namespace strut
