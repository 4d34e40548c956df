// Moves the state of a run from one partition to another in memory.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/archive.hpp"

namespace strut {

class Communicator;

// New ranks of the points: id and rank of each point of this rank, sorted by id.
using RanksOfPoints = std::vector<std::pair<std::int64_t, int>>;

// Collective. Fills `to`, a snapshot of the same run on the new partition, with the values of `from`, on the old one.
// Each rank keeps its own sums (Snapshot::rank_sums).
void move_snapshot(const Snapshot& from, const RanksOfPoints& ranks, Snapshot& to, const Communicator& communicator);

}  // namespace strut
