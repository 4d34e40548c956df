// What a run holds, taken from one partition to another in memory.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/archive.hpp"

namespace strut {

class Communicator;

// Where points are to be: their ids and ranks, of the points of this rank, by ids.
using RanksOfPoints = std::vector<std::pair<std::int64_t, int>>;

// Collective. Fills `to`, a snapshot of the same run where its points are now, with the values of `from`, where they
// were. Of shares each rank keeps its own.
void move_snapshot(Snapshot from, const RanksOfPoints& ranks, Snapshot& to, const Communicator& communicator);

}  // namespace strut
