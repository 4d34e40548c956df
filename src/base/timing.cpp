#include "base/timing.hpp"

#include <Teuchos_Time.hpp>
#include <algorithm>
#include <deque>
#include <span>
#include <sstream>

#include "base/parallel/gather_scatter.hpp"

namespace strut {

namespace {

std::deque<Teuchos::Time>& phases() {  // a deque keeps references valid
  static std::deque<Teuchos::Time> all;
  return all;
}

// Collective. The phases of all ranks, those of rank 0 first: a rank may not have entered a phase of another.
std::vector<std::string> names_on_all_ranks(const Communicator& communicator) {
  std::string mine;
  for (const Teuchos::Time& timer : phases()) mine += timer.name() + "\n";
  const std::vector<char> gathered = gather(communicator, std::span<const char>(mine));
  std::string all(gathered.begin(), gathered.end());
  communicator.broadcast(all);
  std::vector<std::string> names;
  std::istringstream lines(all);
  for (std::string name; std::getline(lines, name);) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace

Teuchos::Time& phase(const std::string& name) {
  for (Teuchos::Time& timer : phases()) {
    if (timer.name() == name) return timer;
  }
  return phases().emplace_back(name);
}

void reset_phases() {
  for (Teuchos::Time& timer : phases()) timer.reset();
}

namespace {

Teuchos::Time* running = nullptr;

}  // namespace

Timed::Timed(Teuchos::Time& phase) : phase_(phase), outer_(running) {
  if (outer_) outer_->stop();
  phase_.start();
  running = &phase_;
}

Timed::~Timed() {
  phase_.stop();
  if (outer_) outer_->start();
  running = outer_;
}

double seconds_outside(std::initializer_list<const char*> waiting) {
  double sum = 0;
  for (const Teuchos::Time& timer : phases()) {
    if (std::find(waiting.begin(), waiting.end(), timer.name()) == waiting.end()) sum += timer.totalElapsedTime();
  }
  return sum;
}

std::vector<PhaseTime> phase_times(const Communicator& communicator) {
  std::vector<PhaseTime> times;
  for (const std::string& name : names_on_all_ranks(communicator)) {
    const double seconds = phase(name).totalElapsedTime();
    times.push_back({name, communicator.sum(seconds) / communicator.size(), communicator.max(seconds)});
  }
  return times;
}

}  // namespace strut
