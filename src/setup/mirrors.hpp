// Symmetry planes of the deck, by which bodies go on as mirror images.
#pragma once

#include <string>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "topology/domain.hpp"

namespace strut {

// Those of node sets; where all points are named, or a block, they keep their distance to the plane (plane strain).
std::vector<Mirror> symmetry_planes(const deck::Deck& deck);

struct Mirrors {
  std::vector<Mirror> planes;  // of each body that ends there, normals inward
  std::string warnings;        // a line for each that is none
};

// Collective. A body ends at a plane where its points are on one side of it and those at the plane are in the set, and
// no others. Throws Error on all ranks where planes of one body meet at an angle that is not 180°/n.
Mirrors mirrors(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator);

}  // namespace strut
