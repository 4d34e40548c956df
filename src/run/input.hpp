// Input of a run, with all errors that can be found before it starts.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "deck/deck.hpp"
#include "io/exodus/exodus.hpp"
#include "topology/cloud.hpp"

namespace strut {

class Communicator;

// Collective. The mesh of a deck that has been read. Throws one Error on all ranks for all problems: those that the
// deck has already, those of the mesh, of the names of output variables, and of files that cannot be replaced.
// `in_memory`: the mesh of a deck of Type Memory, on rank 0.
PointCloud checked_mesh(const deck::Deck& deck, deck::Problems problems, const Communicator& communicator,
                        const io::Mesh* in_memory = nullptr);

// A deck that asks to resume (Peridigm's Restart) must not start anew without a message if there is a checkpoint,
// which it would replace, or if there is none although it describes a later part of a run. `is_there`: the
// checkpoint.
void check_resumption(const deck::Deck& deck, bool is_there, bool begins_anew, deck::Problems& problems);

// Collective. Checks, before the mesh is read, whether the run can resume from a checkpoint or start without it.
// Returns true if it resumes from one with thermal strains.
bool check_checkpoint(const deck::Deck& deck, bool begins_anew, const Communicator& communicator,
                      deck::Problems& problems);

// The sets that only the history has, which may begin or end with any part of a run.
std::set<std::string> names_of_probes(const deck::Deck& deck);

// The contents of the deck's user libraries: no key shows that one has been compiled anew.
class UserLibraries {
 public:
  UserLibraries(const deck::Deck& deck, const Communicator& communicator);  // collective; reads them
  void serialize(Archive& archive);
  // Names the keys whose libraries differ from those of the checkpoint; "" if none does.
  std::string changed() const;

 private:
  struct Library {
    std::string path;     // "Materials > m > Library: 'law.so'"
    double mark, before;  // a check sum of its bytes; the same of the checkpoint
  };
  std::vector<Library> all_;  // by the names of the materials, whose order in a deck is free
};

}  // namespace strut
