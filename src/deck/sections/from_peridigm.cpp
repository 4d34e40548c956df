#include "deck/sections/from_peridigm.hpp"

#include <utility>

namespace strut::deck {

Key without_effect(Key key, const std::string& why) {
  key.meaning = "Accepted for Peridigm's decks; no effect: " + why + ".";
  key.no_effect = why;
  return key;
}

Key verbose_without_effect() {
  return without_effect({.name = "Verbose", .kind = Kind::boolean, .fallback = "false"},
                        "the program says what it does at all times");
}

}  // namespace strut::deck
