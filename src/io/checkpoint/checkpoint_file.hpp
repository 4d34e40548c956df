// A checkpoint as a file. Calls are collective.
#pragma once

#include <filesystem>
#include <string>

#include "base/archive.hpp"

namespace strut {
class Communicator;
}

namespace strut::io {

// One file at any number of ranks (netCDF, points in the order of their ids). It gets its name when it is whole on
// disk, not before, so that a write that is killed spoils nothing; the one that was there stays beside it (before_of in
// base/files.hpp), in place of the one before that. `deck`: the text of the deck.
// Throws Error on all ranks: the file cannot be created, the disk is full.
void write_checkpoint(const std::filesystem::path& file, const Communicator& communicator, const Snapshot& snapshot,
                      const std::string& deck);

struct Restored {
  std::string deck;  // its text
  std::string note;  // on rank 0: why the file before was read, if it was
};

// Fills a snapshot that was saved from the same deck, by any number of ranks: each gets the values of the points that
// it has; of shares each rank its own, or, where their number is another, rank 0 the sums. Where the
// file is missing or damaged, the one before is read in its place, if it is good. Throws Error on all ranks: both
// missing or damaged, of another version; of other points, or without something that the snapshot has.
Restored read_checkpoint(const std::filesystem::path& file, const Communicator& communicator, Snapshot& snapshot);

// On this rank's disk: the file, or the one before.
bool checkpoint_is_there(const std::filesystem::path& file);

// On rank 0's disk, with the one before. Throws Error for a file that is there, but none of ours.
void remove_checkpoint(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace strut::io
