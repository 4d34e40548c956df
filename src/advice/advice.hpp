// Warnings before the first step: what in a scene may differ from its author's intention.
#pragma once

#include <string>

#include "deck/deck.hpp"
#include "setup/scene.hpp"

namespace strut {

struct Advice {
  std::string outline;   // box, mass, wave speeds, speeds: numbers that show errors of units
  std::string warnings;  // a line each, first those of the set-up
};

// Collective. Throws Error on all ranks if contact certainly cannot withstand an impact.
Advice advice(const deck::Deck& deck, const Scene& scene);

}  // namespace strut
