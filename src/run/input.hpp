// What a run reads, and all that can be known to be wrong before it begins.
#pragma once

#include <filesystem>

#include "deck/deck.hpp"
#include "topology/cloud.hpp"

namespace strut {

class Communicator;

// Collective. The mesh of a deck that has been read; throws one Error on all ranks for all problems: those that the
// deck has already, those of the mesh, of the names of output variables, and of files that cannot be replaced.
PointCloud checked_mesh(const deck::Deck& deck, deck::Problems problems, const Communicator& communicator);

// A deck that itself asks to resume (Peridigm's Restart) does not begin anew without a word where there is a
// checkpoint, which it would replace, nor where there is none and it is of a later part of a run. `is_there`: the
// checkpoint.
void check_resumption(const deck::Deck& deck, bool is_there, bool begins_anew, deck::Problems& problems);

}  // namespace strut
