// Records that ranks send to each other, whoever they know to want them.
#pragma once

#include <span>
#include <vector>

namespace strut {

class Communicator;

// Collective. `width` doubles a record; the k-th one goes to ranks[k], which ascend. Returns what has come to this
// rank, also from itself, in the order of the ranks that sent it.
std::vector<double> sent_to_ranks(std::span<const int> ranks, std::span<const double> records, int width,
                                  const Communicator& communicator);

}  // namespace strut
