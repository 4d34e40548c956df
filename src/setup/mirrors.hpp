// Symmetry planes of the deck behind which bodies continue as mirror images.
#pragma once

#include <string>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "topology/cloud.hpp"
#include "topology/domain.hpp"

namespace strut {

// The planes of node sets. Points of `all` or of a block keep their distance to the plane instead (plane strain).
std::vector<Mirror> symmetry_planes(const deck::Deck& deck);

struct Mirrors {
  std::vector<Mirror> planes;  // of each body that ends there; normals point into the body
  std::string warnings;        // a line for each plane without mirror images
};

// Collective. A body ends at a plane if its points are on one side of it and exactly those at the plane are in the set.
// Throws Error on all ranks if planes of one body meet at an angle that is not 180°/n.
Mirrors mirrors(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator);

// Collective. Adds to the surface of the cells those faces behind which the body does not continue.
void add_faces_without_images(const deck::Deck& deck, const FacesOnPlanes& faces, const Communicator& communicator,
                              PointCloud& cloud);

// Collective. Takes off the surface of partly filled cells what is only their cut by a plane or side behind which the
// body continues.
void take_off_cuts(const deck::Deck& deck, const Communicator& communicator, PointCloud& cloud);

}  // namespace strut
