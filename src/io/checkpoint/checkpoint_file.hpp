// A checkpoint file. Calls are collective.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/archive.hpp"

namespace strut {
class Communicator;
}

namespace strut::io {

// Writes one file on any number of ranks (netCDF, points in the order of their ids). It gets its name only when it is
// complete on disk, so that a killed write does no harm; the previous file is kept beside it (before_of in
// base/files.hpp), and replaces the one before that. `deck`: the text of the deck. Throws Error on all ranks if the
// file cannot be created or the disk is full.
void write_checkpoint(const std::filesystem::path& file, const Communicator& communicator, const Snapshot& snapshot,
                      const std::string& deck);

// Fills a snapshot of the same deck, saved by any number of ranks: each rank gets the values of its points and its own
// shares (per-rank sums); if the number of ranks differs, rank 0 gets the total of the shares. If the file is missing
// or damaged, the previous one is read if it is good; returns the reason, on rank 0. Throws Error on all ranks if both
// are missing or damaged, of another version, of other points, or lack something that the snapshot has.
std::string read_checkpoint(const std::filesystem::path& file, const Communicator& communicator, Snapshot& snapshot);

// On this rank's disk: true if the file, or the previous one, exists.
bool checkpoint_is_there(const std::filesystem::path& file);

// Data besides the snapshot: the file that is read, the newest or, if that is damaged, the previous one, whose reason
// is the note, on rank 0; the text of the deck, and the time, s. All of the file is checked. Throws Error on all ranks
// like read_checkpoint.
struct CheckpointFacts {
  std::filesystem::path file;
  std::string note, deck;
  double time = 0;
  bool has_expanded = false;  // it has thermal strains
};
CheckpointFacts facts_of_checkpoint(const std::filesystem::path& file, const Communicator& communicator);

// Fills what that file, of a run of another deck, has of the numbers, shares and columns whose names `takes` accepts,
// as above; the others keep their values. Returns those that it should take and the file does not have, on all ranks,
// columns with their group. Throws Error on all ranks if the file is not the one of these facts any more, if it is
// damaged, or if the points of a group are others.
using Takes = std::function<bool(const std::string& name)>;
std::vector<std::string> read_checkpoint_parts(const CheckpointFacts& facts, const Communicator& communicator,
                                               const Takes& takes, Snapshot& snapshot);

// Removes the file and the previous one on rank 0's disk. Throws Error if the file is not a checkpoint of ours.
void remove_checkpoint(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace strut::io
