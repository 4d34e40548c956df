// Bodies that move rigidly or rest, until a contact, a load or a condition gives one of their points another velocity.
// They are not strained, and mechanics skips them.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// Collective. Marks the blocks of bodies (BlockBonds::body) whose points are all at their reference positions, without
// stress, and no others. Solvers call it at their start; code that moves points by hand afterwards calls it again.
void find_rigid_motion(Body& body);

bool all_move_rigidly(const Body& body);

// Collective while any body is in rigid motion, else free. Unmarks the bodies whose points no longer have one velocity,
// to the last bit. Call it when velocities are final, before the points move. Until the first body is unmarked, ghosts
// are at their reference positions; from then on at their positions at the start of the step.
// `met`: marks owned points that a tool may move within the step, in substeps; may be empty.
void update_rigid_motion(Body& body, const std::vector<std::uint8_t>& met = {});

}  // namespace strut
