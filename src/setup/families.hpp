// Families of the points that are left when those are dropped that cannot carry a shape tensor.
#pragma once

#include <string>

#include "deck/deck.hpp"
#include "mechanics/body.hpp"
#include "setup/dropped.hpp"

namespace strut {

// Collective. Families of the partitioned cloud, less the points that the deck lets go; `dropped` tells of these.
// `mirrors`: by which bodies go on.
// Throws Error on all ranks where the deck does not let them go.
Domain domain_without_degenerate_points(const deck::Deck& deck, PointCloud cloud, const std::vector<Mirror>& mirrors,
                                        const Communicator& communicator, Dropped& dropped);

// Collective. The warnings of blocks with points whose families nearly lie in a plane.
std::string flat_families(const Body& body);

}  // namespace strut
