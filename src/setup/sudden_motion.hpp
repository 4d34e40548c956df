// Values of conditions over a run that throw points from one place to another within a step.
#pragma once

#include <string>

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "setup/contradictions.hpp"

namespace strut {

// Collective. Displacements that are not zero at the initial time, where bodies are undeformed: with explicit steps a
// problem, the same on all ranks; else told.
std::string check_initial_displacements(const deck::Deck& deck, const PointsOfConditions& points, const Body& body,
                                        deck::Problems& problems);

// Collective. Of explicit steps: displacements and travels of tools that jump, a line each.
std::string sudden_motions(const deck::Deck& deck, const PointsOfConditions& points, const Body& body);

}  // namespace strut
