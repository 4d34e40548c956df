// Non-reflecting ends of a scene, all of them together: each is one layer of points, and what lies beyond them is taken
// off the inertia of their points.
#pragma once

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "setup/scene.hpp"

namespace strut {

// Collective; with all conditions in the scene. The same problems on all ranks.
void take_off_what_is_beyond_ends(const deck::Deck& deck, Scene& scene, deck::Problems& problems);

}  // namespace strut
