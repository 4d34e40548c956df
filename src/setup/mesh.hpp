// The mesh that a deck names, and the node sets that it makes.
#pragma once

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "topology/cloud.hpp"

namespace strut {

// Collective. The points of the mesh or of the built-in grid.
PointCloud read_mesh(const deck::Deck& deck, const Communicator& communicator);

// Collective. Names of the mesh that mean something else in a deck.
void check_names(const PointCloud& cloud, const Communicator& communicator, deck::Problems& problems);

// Collective. Points that are at one place, and places that numbers do not resolve.
void check_places(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                  deck::Problems& problems);

// Collective. The node sets that the deck makes, added to those of the mesh.
void add_node_sets(const std::vector<deck::NodeSet>& sets, PointCloud& cloud, const Communicator& communicator,
                   deck::Problems& problems);

}  // namespace strut
