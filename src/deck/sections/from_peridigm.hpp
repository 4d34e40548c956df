// What several sections have because users of Peridigm will try it.
#pragma once

#include <string>

#include "deck/schema.hpp"

namespace strut::deck {

// A key that Peridigm's decks have and that changes nothing here.
Key without_effect(Key key, const std::string& why);

Key verbose_without_effect();

}  // namespace strut::deck
