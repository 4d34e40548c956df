// Keys of several sections that exist because users of Peridigm will try them.
#pragma once

#include <string>

#include "deck/schema.hpp"

namespace strut::deck {

// A key of Peridigm's decks that has no effect here.
Key without_effect(Key key, const std::string& why);

Key verbose_without_effect();

}  // namespace strut::deck
