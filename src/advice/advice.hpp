// What a scene may mean otherwise than its author meant it, before the first step.
#pragma once

#include <string>

#include "deck/deck.hpp"
#include "setup/scene.hpp"

namespace strut {

struct Advice {
  std::string outline;   // box, mass, wave speeds, speeds: what slips of units change
  std::string warnings;  // a line each; those that the set-up has found first
};

// Collective. Throws Error on all ranks where contact surely cannot hold what runs into it.
Advice advice(const deck::Deck& deck, const Scene& scene);

}  // namespace strut
