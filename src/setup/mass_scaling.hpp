// Mass scaling: adds mass to points that would make the time step shorter than the deck allows.
#pragma once

#include <string>

#include "deck/deck.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Collective; for a body at rest before its first step. Scales the masses if the deck asks for it. Returns the largest
// frequency bound allowed for a point, 1/s; 0 if nothing is scaled. `report`: the added mass, a line for each block.
// Throws Error on all ranks if it exceeds the limit in the deck.
double scale_masses(const deck::Deck& deck, Body& body, std::string& report);

// The same with a given bound: the density of a point with a higher bound (mechanics/frequency_bound.hpp) is multiplied
// by the square of the ratio.
void scale_masses(double highest, Body& body);

}  // namespace strut
