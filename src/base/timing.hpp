// Where the time of a run goes: named phases on Teuchos timers, and their table.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace Teuchos {
class Time;
}

namespace strut {

class Communicator;

// The timer of a phase, made at the first call with its name. Keep the reference: the look-up is by string.
Teuchos::Time& phase(const std::string& name);

// Times a phase from here to the end of the scope. A phase within another one counts for itself alone, so that all add
// up to what was timed.
class Timed {
 public:
  explicit Timed(Teuchos::Time& phase);
  ~Timed();
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  Teuchos::Time& phase_;
  Teuchos::Time* outer_;  // that waits meanwhile
};

struct PhaseTime {
  std::string name;
  double mean, longest;  // s over ranks
};

// What this rank has taken in phases other than these, s: those in which it waits for others.
double seconds_outside(std::initializer_list<const char*> waiting);

// Collective. All phases of all ranks in the order of their first use; on a rank that never came to one it took no
// time.
std::vector<PhaseTime> phase_times(const Communicator& communicator);

}  // namespace strut
