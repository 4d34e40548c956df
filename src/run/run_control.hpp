// Tasks of a run besides its steps: checkpoints, output, limits, progress, and the reaction to signals.
#pragma once

#include <chrono>
#include <initializer_list>
#include <optional>
#include <string>

#include "checkpoint/checkpoint.hpp"
#include "deck/deck.hpp"
#include "output/writers.hpp"
#include "run/monitor.hpp"
#include "run/report.hpp"
#include "setup/scene.hpp"

namespace strut {

// From now on these signals (of csignal) end the run after the current step, or its first one.
void catch_signals(std::initializer_list<int> signals);
bool is_signalled();
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

// Objects of a run besides its solver.
struct RunServices {
  const deck::Deck& deck;
  const Scene& scene;
  OutputWriters& writers;
  Checkpoint& checkpoint;
  Monitor& monitor;
  const EarlyEnd& early_end;
};

// Control of an explicit run. Ranks agree on the tasks of the next time one step ahead, so that all compute energies at
// times of output or checkpoints.
class ExplicitRunControl {
 public:
  ExplicitRunControl(const RunServices& services, const CentralDifference& solver);

  // Collective. Between advance_position() and advance_velocity(): saves a checkpoint if one is due.
  void save(CentralDifference& solver);
  // Collective. After advance_velocity(): output, limits, progress. Returns true if this was the last time.
  bool observe(CentralDifference& solver);
  // Before advance_position(): tells the solver this rank's requests; returns true if diagnostics are needed next.
  bool prepare_next(CentralDifference& solver);

  // True if no step follows.
  bool ends_here(const CentralDifference& solver) const { return is_over(solver) || ending_; }

  void finish() { progress_.finish(); }

 private:
  bool is_over(const CentralDifference& solver) const { return solver.time() >= services_.deck.solver.final_time; }
  void warn_of_fixed_step(const CentralDifference& solver);

  RunServices services_;
  Progress progress_;
  bool warned_ = false, ending_ = false, saving_ = false;
};

}  // namespace strut
