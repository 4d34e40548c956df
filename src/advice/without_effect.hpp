// Sections of a deck without any effect, which are mostly mistakes in a name or a unit.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A warning, a line each, of damage models that no block names, models of contact that no interaction
// names, cracks that cut no bond, and node sets of the deck that hold all points.
std::string without_effect(const Situation& situation);

}  // namespace strut
