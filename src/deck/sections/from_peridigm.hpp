// What several sections have because users of Peridigm will try it.
#pragma once

#include <string>

#include "deck/schema.hpp"

namespace strut::deck {

// A key that Peridigm's decks have and that changes nothing here.
Key without_effect(Key key, const std::string& why);

Key verbose_without_effect();

// About Damage Models and the like.
inline const char* const bonds_hold = "reserved: not in this version (bonds do not break)";

}  // namespace strut::deck
