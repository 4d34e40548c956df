// A run, from deck to result.
#pragma once

#include <filesystem>
#include <limits>
#include <memory>

#include "deck/deck.hpp"
#include "io/exodus/exodus.hpp"
#include "output/writers.hpp"
#include "setup/scene.hpp"

namespace strut {

enum class Start { anew, continued };  // continued: from the checkpoint of an earlier run of the deck, if there is one

// Collective. Runs the deck, which names the files that it writes. Throws Error on all ranks. Returns false if a signal
// (SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU) or the deck's wall time ended it early, with a checkpoint and
// everything written so far readable.
bool run(const std::filesystem::path& deck, const Communicator& communicator, Start start = Start::anew);

// Collective. Validates the deck and its mesh and prints a forecast of the run: points, bonds, memory, critical time
// step, number of steps, time.
void check(const std::filesystem::path& deck, const Communicator& communicator);

// Where a run pauses: after so many (load) steps, or at the first one at or after the time (s).
struct Pause {
  int steps = std::numeric_limits<int>::max();
  double time = std::numeric_limits<double>::infinity();
};

// Input and output that a script in Python keeps in memory, in place of files.
struct InMemory {
  const io::Mesh* mesh = nullptr;  // of a deck of Type Memory, on rank 0; for the set-up only
  HistoryRows* history = nullptr;  // gets the rows, if the deck has the section History
};

// A run that its owner advances. All functions are collective where they are not const, and throw Error on all ranks;
// after an error it has ended.
class Run {
 public:
  // Sets up, and opens the files. `problems`: of the deck; all are thrown together.
  Run(deck::Deck deck, deck::Problems problems, const Communicator& communicator, Start start,
      const InMemory& in_memory = {});
  ~Run();

  // Returns true at a pause, where all fields are complete, and false if the run has ended.
  bool advance(const Pause& pause = {});
  void end();  // early, after one more step: with a last frame and a checkpoint

  bool has_ended() const;
  bool is_over() const;  // at the final time
  double time() const;   // s
  int steps() const;
  const Scene& scene() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace strut
