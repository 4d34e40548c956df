// Mass scaling: mass for the points that would make the time step shorter than the deck wants it.
#pragma once

#include <string>

#include "deck/deck.hpp"
#include "mechanics/body.hpp"

namespace strut {

// Collective; of a body at rest that no step was made of. Scales the masses where the deck asks for it. Returns the
// frequency that no point is to exceed, 1/s: 0 where nothing is scaled. `report`: the mass that was added, a line for
// each block. Throws Error on all ranks where it would be more than the deck allows.
double scale_masses(const deck::Deck& deck, Body& body, std::string& report);

// The same by the frequency that is known: a point whose bound (mechanics/frequency_bound.hpp) is higher has its
// density times the square of the ratio.
void scale_masses(double highest, Body& body);

}  // namespace strut
