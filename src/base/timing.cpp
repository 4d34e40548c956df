#include "base/timing.hpp"

#include <Teuchos_Time.hpp>
#include <deque>

#include "base/communicator.hpp"

namespace strut {

namespace {

std::deque<Teuchos::Time>& phases() {  // a deque: references stay valid
  static std::deque<Teuchos::Time> all;
  return all;
}

}  // namespace

Teuchos::Time& phase(const std::string& name) {
  for (Teuchos::Time& timer : phases()) {
    if (timer.name() == name) return timer;
  }
  return phases().emplace_back(name);
}

Timed::Timed(Teuchos::Time& phase) : phase_(phase) { phase_.start(); }

Timed::~Timed() { phase_.stop(); }

std::vector<PhaseTime> phase_times(const Communicator& communicator) {
  std::vector<PhaseTime> times;
  for (const Teuchos::Time& timer : phases()) {
    const double seconds = timer.totalElapsedTime();
    times.push_back({timer.name(), communicator.sum(seconds) / communicator.size(), communicator.max(seconds)});
  }
  return times;
}

}  // namespace strut
