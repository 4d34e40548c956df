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

// Collective. What speaks against a run from the beginning: what stands in the place of the checkpoint is none, or the
// deck itself asks to resume. Adds what rank 0 alone sees there, which checked_mesh() tells all.
void check_new_run(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems);

}  // namespace strut
