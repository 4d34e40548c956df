// From a deck to the objects of a run: the one place that knows both.
#pragma once

#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "conditions/conditions.hpp"
#include "mechanics/mechanics.hpp"
#include "solvers/explicit/central_difference.hpp"
#include "solvers/quasi_static/quasi_static.hpp"

namespace strut {

struct Scene {
  Body body;
  Conditions conditions;
  contact::Contact contact;
  StepControl control;
  std::optional<QuasiStaticControl> quasi_static;   // in its place
  std::int64_t points = 0, bonds = 0, dropped = 0;  // over all ranks
  std::string warnings;                             // what may be meant otherwise, a line each
};

// Collective. Reads the mesh, makes node sets, partition, families, body, initial velocities and conditions.
// Throws one Error on all ranks for what only mesh and deck together show: blocks and node sets that do not exist or
// hold no point, horizons that do not fit the spacing; then one for points with too few neighbors.
Scene set_up(const deck::Deck& deck, const Communicator& communicator);

}  // namespace strut
