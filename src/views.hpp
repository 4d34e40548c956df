// What a deck asks to see of a body, by name.
#pragma once

#include "deck/deck.hpp"
#include "mechanics/observables.hpp"

namespace strut {

struct Views {
  std::vector<Observable> frame;  // Output > Output Variables
  std::vector<Extreme> extremes;  // History > Variables
};

// Collective. Throws one Error for all unknown names, and extremes over no point.
Views views_of(const deck::Deck& deck, const Body& body);

}  // namespace strut
