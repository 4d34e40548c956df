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
// per-rank sums; if the number of ranks differs, rank 0 gets the total of these sums. If the file is missing
// or damaged, the previous one is read if it is good; returns the reason, on rank 0. Throws Error on all ranks if both
// are missing or damaged, of another version, of other points, or lack something that the snapshot has.
std::string read_checkpoint(const std::filesystem::path& file, const Communicator& communicator, Snapshot& snapshot);

// On this rank's disk: true if the file, or the previous one, exists.
bool checkpoint_is_there(const std::filesystem::path& file);

// Data of a checkpoint besides the snapshot. `file`: the file that is read, which is the newest one or, if that is
// damaged, the previous one; `note`: the reason for the latter, on rank 0; `deck`: its text; `time`: s. The whole file
// is checked. Throws Error on all ranks like read_checkpoint.
struct CheckpointFacts {
  std::filesystem::path file;
  std::string note, deck;
  double time = 0;
  bool has_expanded = false;  // it has thermal strains
};
CheckpointFacts facts_of_checkpoint(const std::filesystem::path& file, const Communicator& communicator);

// Fills the numbers, per-rank sums and columns of a snapshot whose names `takes` accepts from the file of these facts,
// which may be of a run of another deck; the others keep their values. Returns the accepted names that the file lacks,
// on all ranks, columns with their group. Throws Error on all ranks if the file has been replaced since, if it is
// damaged, or if a group has other points.
using Takes = std::function<bool(const std::string& name)>;
std::vector<std::string> read_checkpoint_parts(const CheckpointFacts& facts, const Communicator& communicator,
                                               const Takes& takes, Snapshot& snapshot);

// Removes the file and the previous one on rank 0's disk. Throws Error if the file is not a checkpoint of ours.
void remove_checkpoint(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace strut::io
