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

// Collective, if a checkpoint exists: prints how the deck differs from that of the checkpoint. Throws Error on all
// ranks for changes with which a run cannot continue, each with its key, and for a final time that has passed. Returns
// true if the checkpoint has thermal strains.
bool check_changes(const deck::Deck& deck, const Communicator& communicator);

class Checkpoint {
 public:
  // Saves or restores all that a checkpoint contains.
  using Serialize = std::function<void(Archive&)>;

  // Collective. Throws Error on all ranks if another run in progress writes checkpoints with the same name.
  Checkpoint(const deck::Deck& deck, const Communicator& communicator, Serialize serialize);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  // Collective. Throws Error on all ranks if the file is damaged, or belongs to another model.
  void load();
  void remove();  // collective: removes the checkpoint of an earlier run; throws Error if the file is none
  // Collective; at the end of a completed run: removes its checkpoints, unless the deck keeps the state at the end, or
  // the run was resumed.
  void close();

  bool is_scheduled(int step, double time) const;  // by the steps or the time of the simulation
  bool is_scheduled_by_clock() const;              // on this rank
  bool is_scheduled_at_end() const { return settings_.enabled && settings_.kept_at_end; }
  void write(int step, double time);  // collective; throws Error if the disk is full

  // How to resume after an error, for the error message.
  std::string hint() const;
  // After close(): the line that names the file of a finished run, empty if there is none.
  std::string kept() const;

 private:
  deck::Restart settings_;
  std::string deck_name_, deck_text_;
  Communicator communicator_;
  Serialize serialize_;
  bool has_left_over_;  // an earlier run has left a checkpoint, and this run writes none
  Schedule schedule_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  int last_step_ = 0;  // last step written or loaded
  double last_time_ = 0;
  bool written_ = false;
  std::optional<io::FileLock> lock_;  // on rank 0, for a separate file, because each checkpoint replaces the last one
};

}  // namespace strut
