// Periodic sides of the deck.
#pragma once

#include <string>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "conditions/tool_shapes.hpp"
#include "deck/deck.hpp"
#include "topology/domain.hpp"

namespace strut {

// Both sides of each period, on which elements end and meet their images; for reading a mesh.
std::vector<Mirror> sides_of_periods(const deck::Deck& deck);

// Collective. The periods of the deck; throws Error on all ranks where they do not fit to the points or other
// conditions. `mirrors`: of the bodies.
std::vector<Period> periods(const deck::Deck& deck, const PointCloud& cloud, const std::vector<Mirror>& mirrors,
                            const Communicator& communicator);

// Removes the ends of a box along the axis of a period as long as the box: the box touches its own images there.
void join_images(const std::vector<Period>& periods, Shape& shape);

// For each site the period along each axis that it is an image by, m: 0 for all but images.
std::vector<Vector> shifts_by_periods(const Domain& domain);

// Collective. A warning for each period whose upper side has elements that meet none of those at the lower side.
std::string open_sides(const deck::Deck& deck, const Domain& domain);

}  // namespace strut
