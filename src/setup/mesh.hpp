// The mesh that a deck names, and the node sets that it makes.
#pragma once

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "points/cloud.hpp"

namespace strut {

// Collective. The points of the mesh or of the built-in grid.
PointCloud read_mesh(const deck::Deck& deck, const Communicator& communicator);

// Collective. The node sets that the deck makes, added to those of the mesh.
void add_node_sets(const std::vector<deck::NodeSet>& sets, PointCloud& cloud, const Communicator& communicator,
                   deck::Problems& problems);

}  // namespace strut
