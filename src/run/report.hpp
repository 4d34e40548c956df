// Messages of a run for its user, printed by rank 0.
#pragma once

#include <chrono>
#include <string>

#include "advice/advice.hpp"
#include "deck/deck.hpp"
#include "output/variables.hpp"
#include "setup/scene.hpp"

namespace strut {

// A bar with the remaining time on a terminal; in a log, a line for every tenth of the run, and every minute.
class Progress {
 public:
  // `now`: start of this run, later than the initial time if it resumes another one.
  Progress(const Communicator& communicator, double initial_time, double now, double final_time);
  void show(int step, double time, double dt);  // prints if a line is due
  void finish();

 private:
  double elapsed() const;
  std::string left(double time);
  bool speaks_, terminal_;
  double initial_, begin_, final_;
  int shown_ = -1;                         // tenths of the run
  double shown_time_, shown_elapsed_ = 0;  // s, of the last line
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Summary of the input: points, bonds, memory, blocks.
std::string describe_scene(const Scene& scene, const Advice& advice);

// Size of a frame of the result file, bytes.
double frame_bytes(const OutputVariables& variables, std::int64_t points);

// Collective. Peak memory of rank 0, which opens the files, and of the other ranks, including the program itself; size
// of a frame.
std::string memory_and_frame(const Scene& scene, const OutputVariables& variables);

// Warns of a fixed step above the critical one, `limit` at `time` (s); "" if it is not.
std::string step_warning(const StepControl& control, double limit, double time);

// Throws Error if steps are shorter than the resolution of numbers at `time` (s): times would jump, or stand still.
void check_step_at(double time, const StepControl& control, double limit);

// Collective. Throws Error if a user library is stiffer, e.g. by viscosity, in the first steps of its points than its
// elastic constants. `limit`: critical time step, s.
void check_libraries(const Body& body, const StepControl& control, double limit);

// Collective. Tables of time by phase and of work by rank, points·steps per second, ns per bond, the final ledger.
// `before`: number of steps made by an earlier run.
std::string closing_report(const Scene& scene, const CentralDifference& solver, const Ledger& ledger, double seconds,
                           int before);
std::string closing_report(const Scene& scene, const QuasiStatic& solver, const Ledger& ledger, double seconds,
                           int before);

// "1.3 s", "4 min 10 s", "2 h 3 min"
std::string as_duration(double seconds);

}  // namespace strut
