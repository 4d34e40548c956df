// Contact that cannot hold what runs into it, found before the first step (docs/theory.md, "Contact that cannot hold").
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. Warnings, a line each: of points that slip between those of
// the other body; of two bodies whose impact, by the velocities of the start, is a pressure that contact bears only
// where points have passed each other; of parts of one body whose contact bears less than the flow stress. Throws Error
// on all ranks where contact could not take up the energy of the impact even if all points pressed on all that they can
// reach, and no tool or third block may stop them; where the deck goes on beyond its limits (Watch > Beyond Limits)
// that is a warning, too.
std::string weak_contacts(const Situation& situation);

}  // namespace strut
