// Points whose motion several conditions of a deck prescribe, along one axis or along axes that are not across each
// other.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "mechanics/body.hpp"

namespace strut {

using PointsOfConditions = std::vector<std::vector<int>>;  // owned points, by the condition's place in the deck

// One direction in which a condition holds a point.
struct Hold {
  int condition;          // its place in the deck
  Vector direction;       // of unit length
  const Function* value;  // the displacement or velocity along it; null: none
  bool is_velocity;
};

// By points, in the order in which conditions act: motions, planes. Only of points with holds that are not across each
// other.
using SharedPoints = std::map<int, std::vector<Hold>>;
SharedPoints shared_points(const deck::Deck& deck, const PointsOfConditions& points);

// Collective. Two conditions may say the same of a point, or prescribe different directions of its motion; that they
// leave it no motion is among the problems, the same on all ranks. Initial velocities that are given twice, too.
void check_contradictions(const deck::Deck& deck, const PointsOfConditions& points, const Body& body,
                          deck::Problems& problems);

// The change of the velocity of a point by a plane, for each m/s that it has along the normal: along the normal, but in
// the directions that the conditions before it leave free. Zero where they leave none.
Vector push_of_plane(const std::vector<Hold>& holds, int condition);

// Decks of Peridigm (whose sets are numbers of points): there the last condition of a kind counts at a point along an
// axis. Takes the points off the others; returns what is told. Collective.
std::string let_the_last_count(const deck::Deck& deck, const Body& body, PointsOfConditions& points);

}  // namespace strut
