// Values of conditions that change too fast for the steps.
#pragma once

#include <string>

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "setup/contradictions.hpp"

namespace strut {

// yes: points that a condition holds at their positions in the mesh may stay there, although an Initial Displacement
// moves the rest of the body.
enum class MayRest { no, yes };

// Collective. Finds points whose displacement at the initial time is not the one that a condition prescribes for this
// time (in an undeformed body it is 0). With explicit steps that is an error, the same on all ranks; else a warning.
std::string check_initial_displacements(const deck::Deck& deck, const PointsOfConditions& points, const Body& body,
                                        deck::Problems& problems, MayRest may_rest = MayRest::no);

// Collective. Adds a problem for each prescribed velocity, load or force on a tool that goes to infinity in the run.
void check_poles(const deck::Deck& deck, const PointsOfConditions& points, const Body& body, deck::Problems& problems);

// Collective. For explicit steps: warns of changes within one step of displacements, the travel of tools, temperatures
// and the distance of periodic sides, a line each.
std::string sudden_motions(const deck::Deck& deck, const PointsOfConditions& points, const Body& body);

// Collective. For explicit steps: warns of loads and velocities that jump up and down within so few steps that their
// integral depends on where the steps fall, a line each.
std::string sampled_pulses(const deck::Deck& deck, const PointsOfConditions& points, const Body& body);

// Collective. For equilibria: warns of values between two load steps outside of those at both, a line each.
std::string values_between_load_steps(const deck::Deck& deck, const PointsOfConditions& points, const Body& body);

}  // namespace strut
