// A checkpoint as a file. Calls are collective.
#pragma once

#include <filesystem>
#include <string>

#include "base/archive.hpp"

namespace strut {
class Communicator;
}

namespace strut::io {

// One file at any number of ranks (netCDF, points in the order of their ids). The one that was there is replaced when
// the new one is whole on disk, not before: a write that is killed spoils nothing. `deck`: the text of the deck.
// Throws Error on all ranks: the file cannot be created, the disk is full.
void write_checkpoint(const std::filesystem::path& file, const Communicator& communicator, const Snapshot& snapshot,
                      const std::string& deck);

// Fills a snapshot that was saved from the same deck, by any number of ranks: each gets the values of the points that
// it has; of shares each rank its own, or, where their number is another, rank 0 the sums. Returns the text of the
// deck. Throws Error on all ranks: file missing, damaged, of another version; of other points, or without something
// that the snapshot has.
std::string read_checkpoint(const std::filesystem::path& file, const Communicator& communicator, Snapshot& snapshot);

// What was written beside the snapshot: the text of the deck; its time, s. Throws Error on all ranks as
// read_checkpoint.
struct CheckpointFacts {
  std::string deck;
  double time = 0;
};
CheckpointFacts facts_of_checkpoint(const std::filesystem::path& file, const Communicator& communicator);

// Throws Error for a file that is there, but none of ours, which a run would replace.
void check_replaceable(const std::filesystem::path& file);

// On rank 0's disk. Throws Error for a file that is there, but none of ours.
void remove_checkpoint(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace strut::io
