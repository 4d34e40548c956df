// Sends records to given ranks.
#pragma once

#include <span>
#include <vector>

namespace strut {

class Communicator;

// Collective. `width` doubles per record; the k-th one goes to ranks[k], which ascend. Returns the records received by
// this rank, also from itself, in the order of the ranks that sent them.
std::vector<double> sent_to_ranks(std::span<const int> ranks, std::span<const double> records, int width,
                                  const Communicator& communicator);

}  // namespace strut
