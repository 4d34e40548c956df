// Timing of a run: named phases on Teuchos timers, and their table.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace Teuchos {
class Time;
}

namespace strut {

class Communicator;

// The timer of a phase, created by the first call with its name. Keep the reference: the look-up is by string.
Teuchos::Time& phase(const std::string& name);

void reset_phases();  // to 0 s, for a process that makes several runs

// Times a phase from here to the end of the scope. Time in a nested phase counts only there, so that all phases add up
// to the total.
class Timed {
 public:
  explicit Timed(Teuchos::Time& phase);
  ~Timed();
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  Teuchos::Time& phase_;
  Teuchos::Time* outer_;  // the interrupted outer phase
};

struct PhaseTime {
  std::string name;
  double mean, longest;  // s over ranks
};

// The time of this rank in phases other than `waiting`, s; in those it waits for other ranks.
double seconds_outside(std::initializer_list<const char*> waiting);

// Collective. All phases of all ranks in the order of their first use; a rank that never entered a phase has 0 s in it.
std::vector<PhaseTime> phase_times(const Communicator& communicator);

}  // namespace strut
