// Which points may lie at the surface of their body.
#pragma once

#include "topology/domain.hpp"

namespace strut::contact {

// True if a point may lie at the surface of its body: its family is one-sided (0.3 at a flat face, horizon 1.75
// spacings) or, in thin plates, incomplete (0.4 of the volume within the horizon; 0.94 or more inside a lattice). A
// point too many costs time; none may be missed.
bool is_at_surface(const Domain& domain, int i);

}  // namespace strut::contact
