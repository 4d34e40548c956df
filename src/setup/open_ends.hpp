// Non-reflecting ends of a scene: checks that each end is one layer of points, and reduces the inertia of these points
// by the part beyond the ends.
#pragma once

#include "conditions/conditions.hpp"
#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Collective. `conditions`: all ends of the deck are among them. Reports the same problems on all ranks.
void check_open_ends(const deck::Deck& deck, const Conditions& conditions, const Body& body, deck::Problems& problems);
void take_off_what_is_beyond_ends(const Conditions& conditions, Body& body);

}  // namespace strut
