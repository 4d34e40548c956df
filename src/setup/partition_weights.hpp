// Partition weights: the cost of each block's points, and the axes along which cuts are cheap.
#pragma once

#include "deck/deck.hpp"
#include "topology/cloud.hpp"
#include "topology/partition.hpp"

namespace strut {

// Collective. `spacings`: mean spacing of each block, m.
PartitionWeights partition_weights(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                                   const Communicator& communicator);

}  // namespace strut
