// What a run tells the person who waits for it. Rank 0 speaks.
#pragma once

#include <chrono>
#include <string>

#include "advice/advice.hpp"
#include "deck/deck.hpp"
#include "output/variables.hpp"
#include "setup/scene.hpp"

namespace strut {

// A bar with the time left on a terminal; a line every tenth of the way in a log, and every minute.
class Progress {
 public:
  // `now`: where this run begins, which is later than the initial time where it goes on with another.
  Progress(const Communicator& communicator, double initial_time, double now, double final_time);
  void show(int step, double time, double dt);  // where a line is due
  void finish();

 private:
  double elapsed() const;
  std::string left(double time);
  bool speaks_, terminal_;
  double initial_, begin_, final_;
  int shown_ = -1;                         // tenths
  double shown_time_, shown_elapsed_ = 0;  // s, of the last line
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// What was read: points, bonds, memory, blocks.
std::string describe_scene(const Scene& scene, const Advice& advice);

// Bytes that points, bonds and the solver (the estimate of the critical time step, or the search for equilibria) take
// on all ranks; the program itself has some 50 MB a rank, 80 with equilibria.
double predicted_memory(const Scene& scene);

// Of the result file, for each frame.
double frame_bytes(const OutputVariables& variables, std::int64_t points);

// Collective. What rank 0, which opens the files, and the others have taken at most until now, the program itself
// included; what a frame takes.
std::string memory_and_frame(const Scene& scene, const OutputVariables& variables);

// Of a run by explicit steps, s: one of its first lines.
std::string critical_time_step_line(double limit);

// A fixed step above the stable one, `limit` at `time` (s); "" where it is not.
std::string step_warning(const StepControl& control, double limit, double time);

// Collective. The tables of time by phase and of the ranks' shares, points·steps per second, ns per bond, the ledger at
// the end. `before`: steps that were made by an earlier run.
std::string closing_report(const Scene& scene, const CentralDifference& solver, const Ledger& ledger, double seconds,
                           int before);
std::string closing_report(const Scene& scene, const QuasiStatic& solver, const Ledger& ledger, double seconds,
                           int before);

// "1.3 s", "4 min 10 s", "2 h 3 min"
std::string as_duration(double seconds);

}  // namespace strut
