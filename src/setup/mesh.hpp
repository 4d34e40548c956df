// Reads the mesh of a deck, and makes the deck's node sets.
#pragma once

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "io/exodus/exodus.hpp"
#include "topology/cloud.hpp"
#include "topology/domain.hpp"

namespace strut {

// Collective. The points of the mesh, in a file or in memory (on rank 0), or of the built-in grid. Faces on planes of
// the deck go to `apart`, until it is known behind which of them bodies continue (setup/mirrors.hpp).
PointCloud read_mesh(const deck::Deck& deck, const Communicator& communicator, const io::Mesh* in_memory,
                     FacesOnPlanes& apart);

// Collective. Reports names of the mesh that have another meaning in a deck.
void check_names(const PointCloud& cloud, const Communicator& communicator, deck::Problems& problems);

// Collective. Reports faces in a body by quadratic correspondence that meet others with other corners.
void check_faces(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                 const io::Mesh* in_memory, deck::Problems& problems);

// Collective. Reports coincident points, and positions that the floating-point numbers do not resolve.
void check_places(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                  deck::Problems& problems);

// Collective. Adds the node sets of the deck to those of the mesh.
void add_node_sets(const std::vector<deck::NodeSet>& sets, PointCloud& cloud, const Communicator& communicator,
                   deck::Problems& problems);

// Collective. Gives probes whose points have been dropped the nearest remaining points.
void find_probes_again(const std::vector<deck::NodeSet>& sets, Domain& domain);

// Collective. The point of each probe of the history, a line each; a warning if a point is far from its probe.
std::string places_of_probes(const deck::Deck& deck, const Domain& domain);

}  // namespace strut
