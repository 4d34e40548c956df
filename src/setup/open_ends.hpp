// Non-reflecting ends of a scene: checks that each is one layer of points, and reduces the inertia of their points by
// the part beyond the ends.
#pragma once

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "setup/scene.hpp"

namespace strut {

// Collective; call it when all conditions are in the scene. Reports the same problems on all ranks.
void take_off_what_is_beyond_ends(const deck::Deck& deck, Scene& scene, deck::Problems& problems);

}  // namespace strut
