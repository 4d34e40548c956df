// Bodies that fly or rest as a whole, until a contact, a load or a condition makes one of their points move otherwise:
// they are not strained, and mechanics skips them.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

// Collective. Marks the blocks of bodies (BlockBonds::body) whose points are all where they are in the reference state,
// and no others. The solver does at its start; who moves points by hand then does it again.
void find_rigid_motion(Body& body);

bool all_move_rigidly(const Body& body);

// Collective while any body is in rigid motion, else free. Takes the mark off the bodies whose points no longer have
// one velocity, to the last bit. To be asked when velocities are final, before the points move. Until the first of them
// does, places of ghosts are those of the reference state; from then on all of the start of the step.
void update_rigid_motion(Body& body);

}  // namespace strut
