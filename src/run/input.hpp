// What a run reads, and all that can be known to be wrong before it begins.
#pragma once

#include <filesystem>

#include "deck/deck.hpp"
#include "points/cloud.hpp"

namespace strut {

class Communicator;

// Collective. The mesh of a deck that has been read; throws one Error on all ranks for all problems: those that the
// deck has already, those of the mesh, of the names of output variables, and of files that cannot be replaced.
PointCloud checked_mesh(const deck::Deck& deck, deck::Problems problems, const Communicator& communicator);

// Collective. A deck that itself asks to resume is not to begin anew and replace the checkpoint without a word.
void check_not_to_resume(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems);

}  // namespace strut
