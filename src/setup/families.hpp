// Families of the points that remain when those without an invertible shape tensor are dropped.
#pragma once

#include <vector>

#include "deck/deck.hpp"
#include "setup/dropped.hpp"
#include "topology/domain.hpp"

namespace strut {

// Collective. Families of the partitioned cloud, without the points that the deck allows to be dropped; `dropped`
// describes these. `mirrors`: planes of bodies with mirror images; `periods`: periodic sides. Throws Error on all ranks
// if the deck does not allow it.
Domain domain_without_degenerate_points(const deck::Deck& deck, PointCloud cloud, const std::vector<Mirror>& mirrors,
                                        const std::vector<Period>& periods, const Communicator& communicator,
                                        Dropped& dropped);

// Collective. The initial cracks of the deck (Bond Filters), last the surfaces that it names by their files.
std::vector<Crack> cracks_of(const deck::Deck& deck, const Communicator& communicator);

// The points among `points` (owned) that lie on the crack, to round-off: the crack cuts their bonds to both sides.
std::vector<int> points_on(const Crack& crack, const std::vector<int>& points, const Domain& domain);

// Collective. Reads the surfaces of Bond Filters into the deck's cracks once, for all partitions of a run: the files
// may be gone at a later one.
void read_cracks(deck::Deck& deck, const Communicator& communicator);

}  // namespace strut
