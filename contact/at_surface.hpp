// Which points the surface of their body may be of.
#pragma once

#include "topology/domain.hpp"

namespace strut::contact {

// Whether the body's surface may be a point's: its family is one-sided (0.3 at a flat face, horizon 1.75 spacings) or,
// in thin plates, not full (0.4 of the volume within the horizon; inside it is 0.94 or more on a lattice). One too many
// costs time; none may be missed.
bool is_at_surface(const Domain& domain, int i);

}  // namespace strut::contact
