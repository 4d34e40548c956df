// When a run writes a checkpoint, and how it resumes from one.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "base/archive.hpp"
#include "base/parallel/communicator.hpp"
#include "deck/deck.hpp"
#include "io/file_lock.hpp"
#include "output/schedule.hpp"

namespace strut {

bool checkpoint_exists(const deck::Deck& deck, const Communicator& communicator);  // collective: a run has left one

// Collective, of a checkpoint that exists: says how the deck differs from the one it was written with. Throws Error on
// all ranks for changes that a run cannot go on with, each by its key, and for a final time that has passed.
void check_changes(const deck::Deck& deck, const Communicator& communicator);

class Checkpoint {
 public:
  // Passes an archive, which saves or restores, over all that a checkpoint contains.
  using Serialize = std::function<void(Archive&)>;

  // Collective. Throws Error on all ranks: another run that has not ended writes checkpoints under the same name.
  Checkpoint(const deck::Deck& deck, const Communicator& communicator, Serialize serialize);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  // Collective. Throws Error on all ranks: the file is damaged, or of another model.
  void load();
  void remove();  // collective: the checkpoint of an earlier run; throws Error where the file is no checkpoint
  void close();   // collective; at the end of a run that is over: removes the checkpoint unless the deck asks for it

  bool due(int step, double time) const;  // by the steps or the time of the simulation
  bool due_by_the_clock() const;          // on this rank
  bool due_at_the_end() const { return settings_.enabled && settings_.asked_for; }
  void write(int step, double time);  // collective; throws Error when the disk is full

  // How to resume after an error, for its message.
  std::string hint() const;

 private:
  deck::Restart settings_;
  std::string deck_name_, deck_text_;
  Communicator communicator_;
  Serialize serialize_;
  Schedule schedule_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  int last_step_ = 0;  // that was written, or loaded
  double last_time_ = 0;
  bool written_ = false;
  std::optional<io::FileLock> lock_;  // on rank 0, of a file of its own: each checkpoint replaces the last one
};

}  // namespace strut
