// When a run writes what it must know to go on, and how it takes that up again.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "base/archive.hpp"
#include "base/communicator.hpp"
#include "deck/deck.hpp"
#include "schedule.hpp"

namespace strut {

class Restarts {
 public:
  // What is kept, by an archive that saves or restores.
  using Keep = std::function<void(Archive&)>;

  Restarts(const deck::Deck& deck, const Communicator& communicator, Keep keep);

  bool there() const;  // collective: a run has left something

  // Collective. Throws Error on all ranks: what is there is damaged, or of another model.
  void take_up();
  void forget();  // collective: what an earlier run has left

  bool due(int step, double time) const;  // by the steps or the time of the simulation
  bool due_by_the_clock() const;          // on this rank
  bool due_at_the_end() const { return settings_.enabled && settings_.asked_for; }
  void write(int step, double time);  // collective; throws Error when the disk is full

  // How to go on after an error, for its message.
  std::string hint() const;

 private:
  deck::Restart settings_;
  std::string deck_name_, deck_text_;
  Communicator communicator_;
  Keep keep_;
  Schedule schedule_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  int last_step_ = 0;  // that was written, or taken up
  double last_time_ = 0;
  bool written_ = false;
};

}  // namespace strut
