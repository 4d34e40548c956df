// The boundary conditions of a deck, made for the points of a scene.
#pragma once

#include <functional>

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "setup/scene.hpp"

namespace strut {

// Collective. Checks that every condition names a set that contains a point of some rank.
void check_conditions(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                      deck::Problems& problems);

// Collective. Throws Error on all ranks for errors that only mesh and deck together show. `mesh_time`: s, of the body
// as it was read, before the deck's initial time where these conditions follow others.
void add_conditions(const deck::Deck& deck, double mesh_time, Scene& scene, const Communicator& communicator);

// The parts of the other run that this run continues without a change: its time steps, its conditions, its velocities.
struct Continued {
  bool steps = false, conditions = false, velocities = false;
};

// Collective. The same scene, whose body is now in the state of another run (Start From): gives it initial velocities,
// unless it keeps its own, and tools their reaches, unless knows_reaches(its index in the deck). Throws Error on all
// ranks for displacements that would jump.
void begin_from_here(const deck::Deck& deck, const Continued& continued, const std::function<bool(int)>& knows_reaches,
                     Scene& scene, const Communicator& communicator);

}  // namespace strut
