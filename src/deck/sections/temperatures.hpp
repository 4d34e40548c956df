// Checks of thermal expansion that need several sections.
#pragma once

#include "deck/deck.hpp"

namespace strut::deck {

void check_temperatures(const Deck& deck, Problems& problems);

}  // namespace strut::deck
