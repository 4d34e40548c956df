// Points whose motion is prescribed by several conditions of a deck, along one axis or along axes that are not
// orthogonal.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "mechanics/body.hpp"

namespace strut {

using PointsOfConditions = std::vector<std::vector<int>>;  // owned points, by index of the condition in the deck

// One direction in which a condition holds a point.
struct Hold {
  int condition;          // index in the deck
  Vector direction;       // of unit length
  const Function* value;  // displacement or velocity along it; null: zero
  bool is_velocity;
};

// The holds of each point, in the order in which conditions act: motions, then planes. Only points with holds that are
// not orthogonal.
using SharedPoints = std::map<int, std::vector<Hold>>;
SharedPoints shared_points(const deck::Deck& deck, const PointsOfConditions& points);

// Collective. Several conditions may agree at a point, or prescribe different directions of its motion. If they leave
// it no motion, that is an error, the same on all ranks; so are initial velocities that are given twice.
void check_contradictions(const deck::Deck& deck, const PointsOfConditions& points, const Body& body,
                          deck::Problems& problems);

// The change of a point's velocity by a plane, per m/s along its normal: along the normal, but only in the directions
// that the earlier conditions leave free. Zero if they leave none.
Vector push_of_plane(const std::vector<Hold>& holds, int condition);

// For decks of Peridigm (whose sets are numbers of points), in which the last condition of a kind applies to a point
// along an axis. Removes the points from the others; returns the warning. Collective.
std::string let_the_last_count(const deck::Deck& deck, const Body& body, PointsOfConditions& points);

// Collective. Warns of prescribed temperatures all of whose points later conditions override, and of constant ones that
// override no point of an earlier, changing one; a line each.
std::string temperatures_without_effect(const deck::Deck& deck, const Body& body, const PointsOfConditions& points);

}  // namespace strut
