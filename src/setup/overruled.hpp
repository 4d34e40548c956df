// Points that conditions hold, and that rigid tools move all the same.
#pragma once

#include <string>

#include "deck/deck.hpp"
#include "setup/scene.hpp"

namespace strut {

// Collective. A warning for each tool and condition of which the path of the one runs into points that the other moves
// as given, or keeps at a symmetry plane, along the tool's normal: tools act last. A forecast: what else moves such
// points is not seen, nor where forces drive a tool.
std::string overruled_motions(const deck::Deck& deck, const Scene& scene, double start, double duration);

}  // namespace strut
